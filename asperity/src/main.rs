//! The program `asperity`: see `asperity --help`.

mod command;

fn main() -> std::process::ExitCode {
    command::main()
}
