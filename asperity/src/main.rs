//! The program `asperity`: see `asperity --help`.

mod command;

fn main() -> std::process::ExitCode {
    tables::rehearsal::enable();
    command::main()
}
