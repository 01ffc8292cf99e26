//! The book, the README and the files next to them: links have targets, input files are valid, keys,
//! variables and options are those of the programs.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use asperity::scene::file::{key_names, law_names, parse_request, parse_scene};
use roughsurface::surface::file::SurfaceFile;
use roughsurface::surface::heights::DISTRIBUTIONS;
use tables::numbers::plain;
use tables::quantity::plausible::ranges;
use tests::programs::done;
use tests::{files, root};

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// A chapter with what it includes.
fn chapter(name: &str) -> String {
    let path = root().join("docs/src").join(name);
    let line = |line: &str| match line.strip_prefix("{{#include ").and_then(|rest| rest.strip_suffix("}}")) {
        Some(included) => read(&path.parent().unwrap().join(included)),
        None => line.to_owned(),
    };
    read(&path).lines().map(line).collect::<Vec<_>>().join("\n")
}

/// Lines outside and inside of code blocks; of the latter with the language.
fn split(text: &str) -> (Vec<&str>, Vec<(&str, String)>) {
    let (mut prose, mut blocks) = (Vec::new(), Vec::new());
    let mut block: Option<(&str, String)> = None;
    for line in text.lines() {
        match (line.strip_prefix("```"), &mut block) {
            (Some(_), Some(_)) => blocks.extend(block.take()),
            (Some(language), None) => block = Some((language, String::new())),
            (None, Some((_, code))) => code.extend([line, "\n"]),
            (None, None) => prose.push(line),
        }
    }
    assert!(block.is_none(), "a code block without end");
    (prose, blocks)
}

/// What a heading is called in links, on the pages of the book and of forges alike.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().to_lowercase();
    let kept = kept.chars().filter(|c| c.is_alphanumeric() || [' ', '-', '_'].contains(c));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// Targets of the links and pictures of a text.
fn links(text: &str) -> Vec<String> {
    let (prose, _) = split(text);
    let prose = prose.join("\n");
    // Code spans may hold anything.
    let plain: Vec<&str> = prose.split('`').step_by(2).collect();
    let joined = plain.join("");
    let targets = joined.split("](").skip(1);
    targets.map(|rest| rest.split_once(')').expect("a link without end").0.to_owned()).collect()
}

#[test]
fn links_lead_somewhere() {
    let mut wrong = Vec::new();
    let mut count = 0;
    for path in files(&root(), ".md") {
        let text = read(&path);
        for link in links(&text) {
            count += 1;
            if let Some(outside) = link.strip_prefix("https://") {
                let host = outside.split('/').next().unwrap();
                if !host.contains('.') || link.contains(char::is_whitespace) {
                    wrong.push(format!("{}: {link}", path.display()));
                }
                continue;
            }
            let (file, heading) = link.split_once('#').unwrap_or((&link, ""));
            let target = if file.is_empty() { path.clone() } else { path.parent().unwrap().join(file) };
            let found = match target.metadata() {
                Ok(metadata) if metadata.is_file() && heading.is_empty() => metadata.len() > 0,
                Ok(metadata) if metadata.is_file() => {
                    let text = read(&target);
                    let (prose, _) = split(&text);
                    let mut headings = prose.iter().filter(|line| line.starts_with('#'));
                    headings.any(|line| anchor(line.trim_start_matches('#')) == heading)
                }
                Ok(_) => heading.is_empty(),
                Err(_) => false,
            };
            if !found {
                wrong.push(format!("{}: {link}", path.display()));
            }
        }
    }
    assert!(count > 100, "{count} links");
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn summary_has_every_chapter_and_every_figure_is_shown() {
    let source = root().join("docs/src");
    let summary = links(&read(&source.join("SUMMARY.md")));
    let mut shown = BTreeSet::<OsString>::new();
    for path in files(&source, ".md") {
        let name = path.strip_prefix(&source).unwrap().to_str().unwrap().to_owned();
        assert!(name == "SUMMARY.md" || summary.contains(&name), "{name}");
        shown.extend(
            links(&read(&path)).iter().filter_map(|link| Path::new(link).file_name().map(Into::into)),
        );
    }
    for figure in std::fs::read_dir(source.join("figures")).unwrap().flatten() {
        assert!(shown.contains(&figure.file_name()), "{figure:?}");
    }
}

/// Chapters name the folders that implement them, and commands the files that they read.
#[test]
fn paths_in_the_repository_exist() {
    let mut count = 0;
    for path in files(&root().join("docs/src"), ".md") {
        let text = read(&path);
        let (prose, _) = split(&text);
        let prose = prose.join("\n");
        for word in prose.split('`').skip(1).step_by(2).flat_map(str::split_whitespace) {
            let folders = ["asperity/src", "tables/src", "roughsurface/src", "tests/", "examples/", "docs/"];
            if folders.iter().any(|folder| word.starts_with(folder)) {
                count += 1;
                assert!(root().join(word).exists(), "{}: {word}", path.display());
            }
        }
    }
    assert!(count > 30, "{count} paths");
}

/// Blocks of measured numbers are those that `docs/numbers.py` writes; each is on a page and has an end.
#[test]
fn measured_numbers_have_their_command() {
    let scripts: String = files(&root().join("docs/blocks"), ".py").iter().map(|path| read(path)).collect();
    let known: BTreeSet<&str> =
        scripts.split("@block(\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect();
    let mut found = BTreeSet::new();
    for path in files(&root().join("docs/src"), ".md") {
        for rest in read(&path).split("<!-- begin: ").skip(1) {
            let (name, block) = rest.split_once(" -->").unwrap();
            let ended = block.split("<!-- begin: ").next().unwrap().contains("<!-- end -->");
            assert!(ended && known.contains(name), "{}: {name}", path.display());
            found.insert(name.to_owned());
        }
    }
    let missing: Vec<&&str> = known.iter().filter(|name| !found.contains(**name)).collect();
    assert!(known.len() > 5 && missing.is_empty(), "{missing:?}");
}

#[test]
fn input_files_are_valid() {
    let mut kinds = BTreeSet::new();
    for path in files(&root().join("docs/src"), ".md") {
        let text = read(&path);
        for (_, code) in split(&text).1.iter().filter(|(language, _)| *language == "toml") {
            let name = path.to_str().unwrap();
            let kind = code.lines().next().unwrap();
            let error = match kind {
                "# scene" => parse_scene(code, name, &[]).err().map(|error| error.to_string()),
                "# request" => parse_request(code, name, &[]).err().map(|error| error.to_string()),
                "# surface" => SurfaceFile::parse(&path, code.clone()).err().map(|error| error.to_string()),
                // Pieces of such files.
                _ => code.parse::<toml::Table>().err().map(|error| error.to_string()),
            };
            assert!(error.is_none(), "{}: {}", path.display(), error.unwrap());
            kinds.insert(kind.to_owned());
        }
    }
    for kind in ["# scene", "# request", "# surface"] {
        assert!(kinds.contains(kind), "{kind}");
    }
}

#[test]
fn keys_are_documented() {
    let (text, requests) = (chapter("files/scene.md"), chapter("files/request.md"));
    let mut wanted: BTreeSet<&str> = key_names();
    let laws = law_names();
    wanted.extend(laws.iter().map(String::as_str));
    // Keys of [table] are described with the requests.
    let missing: Vec<&&str> = (wanted.iter())
        .filter(|key| !text.contains(**key) && !requests.contains(&format!("`{key}`")))
        .collect();
    assert!(wanted.len() > 40 && missing.is_empty(), "scene.md, request.md: {missing:?}");

    for (keys, unit, least, most) in ranges() {
        let keys: Vec<String> = keys.iter().map(|key| format!("`{key}`")).collect();
        let row = format!("| {} | {unit} | {} | {} |", keys.join(", "), plain(least), plain(most));
        assert!(text.contains(&row), "scene.md: {row}");
    }

    let text = chapter("files/surface.md");
    for entry in DISTRIBUTIONS {
        for word in entry.keys.iter().chain([&entry.name]) {
            assert!(text.contains(&format!("`{word}`")), "surface.md: {word}");
        }
    }
}

/// The variables of a file that a chapter does not name. What derives from a name need not be there.
fn undocumented(file: &Path, name: &str) -> Vec<String> {
    let text = chapter(name);
    let spans: BTreeSet<&str> = text.split('`').skip(1).step_by(2).collect();
    let known = |name: &str| {
        let sources = ["_by_source", "_mesh", "_sectors", "_steps", "_solver", "_model"];
        let base = sources.iter().find_map(|source| name.strip_suffix(source)).unwrap_or(name);
        let base = base.strip_suffix("_error").unwrap_or(base);
        let statistics = ["_mean", "_mean_error", "_std", "_lower", "_upper", "_infinite", "_bias"];
        let derived = ["_end", "_press", "_real_area", "_parameter_std", "_parameter_change", "_history"];
        let mut bases = derived.iter().chain(&statistics).filter_map(|ending| {
            let said = spans.contains(ending) || spans.contains(format!("NAME{ending}").as_str());
            said.then(|| base.strip_suffix(ending)).flatten()
        });
        spans.contains(name) || spans.contains(base) || bases.any(|base| spans.contains(base))
    };
    let file = netcdf::open(file).unwrap();
    let names = file.variables().map(|variable| variable.name());
    names.filter(|name| !known(name)).collect()
}

#[test]
fn variables_are_documented() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "[material]\npreset = \"steel-4340\"\nfracture_toughness_mode_ii = 1e8\n\
                 [asperity]\nradius = 1e-3\n[loading]\nslip_distance = 0.05\n\
                 [numerics]\nelements_per_radius = 4\nsectors = 4\n";
    let run = scene.replace("slip_distance", "interference = 2\nslip_rate = 1\nslip_distance");
    std::fs::write(folder.path().join("scene.toml"), run).unwrap();
    let request = format!("{scene}[table]\ninterference = [1, 4]\nslip_rate = [0.1, 10]\n");
    std::fs::write(folder.path().join("request.toml"), request).unwrap();
    let surface = root().join("examples/scenes/bearing-steel.toml");
    let surface = surface.display();
    for (program, arguments, chapter) in [
        ("asperity", "run scene.toml -o run.nc".to_owned(), "files/run.md"),
        ("asperity", "tabulate request.toml -o table.nc".to_owned(), "files/table.md"),
        (
            "asperity",
            "tabulate request.toml --set table.temperature=[298,500] -o series.nc".to_owned(),
            "files/table.md",
        ),
        (
            "roughsurface",
            format!("predict {surface} --table model:jackson-green --compare all -o friction.nc"),
            "files/friction.md",
        ),
        (
            "roughsurface",
            format!("sample {surface} --table model:hertz --asperities 50 --realizations 4 -o mc.nc"),
            "files/others.md",
        ),
    ] {
        done(program, folder.path(), &arguments);
        let missing = undocumented(&folder.path().join(arguments.split(' ').next_back().unwrap()), chapter);
        assert!(missing.is_empty(), "{chapter} lacks {missing:?}");
    }
}

#[test]
fn commands_have_the_options_that_the_book_gives_them() {
    let mut texts: Vec<PathBuf> = files(&root().join("docs/src"), ".md");
    texts.push(root().join("README.md"));
    texts.push(root().join("roughsurface/src/worked_examples.md"));
    let mut count = 0;
    for path in texts {
        let text = read(&path);
        let blocks = split(&text).1;
        let shells =
            blocks.iter().filter(|(language, _)| *language == "sh").flat_map(|(_, code)| code.lines());
        for line in shells {
            let line = line.split('#').next().unwrap();
            for file in line.split_whitespace().filter(|word| word.starts_with("examples/")) {
                assert!(root().join(file).exists(), "{}: {file}", path.display());
            }
            let words: Vec<&str> = line.split_whitespace().collect();
            let [program @ ("asperity" | "roughsurface"), command, rest @ ..] = &words[..] else {
                continue;
            };
            count += 1;
            let command = match (*command, rest) {
                ("table", [inner, ..]) => format!("table {inner}"),
                (command, _) => command.to_owned(),
            };
            let help = done(program, &root(), &format!("{command} --help")).stdout;
            for option in rest.iter().filter(|word| word.starts_with('-')) {
                assert!(help.contains(option), "{}: {option} of {line}", path.display());
            }
        }
    }
    assert!(count > 15, "{count} commands");
}
