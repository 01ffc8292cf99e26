//! Oversized text inputs: deep nesting, long lists, huge counts, keys without end.

/// Texts that are small or at most some megabytes, and require much work: deep nesting of every kind, long lists,
/// huge counts, keys without end.
pub fn bombs() -> Vec<(&'static str, String)> {
    const DEEP: usize = 100_000;
    let many = |item: &str, count: usize| item.repeat(count);
    let digits = many("9", DEEP);
    vec![
        ("nested lists", format!("a = {}", many("[", DEEP))),
        ("nested lists, closed", format!("a = {}{}", many("[", DEEP), many("]", DEEP))),
        ("nested tables", format!("a = {}1{}", many("{ a = ", DEEP), many(" }", DEEP))),
        ("a key of many parts", format!("{}a = 1", many("a.", DEEP))),
        ("a section of many parts", format!("[{}a]", many("a.", DEEP))),
        ("a section of lists of many parts", format!("[[{}a]]", many("a.", DEEP))),
        ("many sections", (0..DEEP).map(|n| format!("[a{n}]\n")).collect()),
        ("many lists of sections", many("[[a]]\n", DEEP)),
        ("many keys", (0..DEEP).map(|n| format!("a{n} = 1\n")).collect()),
        ("a long list", format!("a = [{}]", many("1.0,", 1_000_000))),
        ("a long list of lists", format!("a = [{}]", many("[[]],", 300_000))),
        ("an endless number", format!("a = {digits}")),
        ("an endless fraction", format!("a = 0.{digits}e{digits}")),
        ("an endless word", format!("a = \"{}\"", many("é", DEEP))),
        ("an endless key", format!("\"{}\" = 1", many("a\\n", DEEP))),
        ("an open text", format!("a = \"\"\"{}", many("\n", DEEP))),
    ]
}

/// The same within input files that are good but for one value.
pub fn asked_for_too_much(kind: &str) -> Vec<(&'static str, String)> {
    let base = "[material]\npreset = \"copper\"\n[asperity]\nradius = 1e-3\n";
    let scene = format!("{base}[loading]\ninterference = 5\nslip_rate = 1\n");
    let rising = |count: usize| (0..count).map(|n| format!("{n}.0,")).collect::<String>();
    match kind {
        "scene" => vec![
            ("a fine mesh", format!("{scene}[numerics]\nelements_per_radius = 1000000000000\n")),
            ("many angles", format!("{scene}[numerics]\nsectors = 9223372036854775807\n")),
            (
                "a long table",
                scene.replace(
                    "preset = \"copper\"\n",
                    &format!(
                        "preset = \"copper\"\nhardening = {{ law = \"table\", plastic_strain = [{0}], factor = [{0}] }}\n",
                        rising(300_000)
                    ),
                ),
            ),
        ],
        "request" => vec![
            (
                "many points",
                format!(
                    "{base}[table]\nslip_rate = [1]\n\
                     interference = {{ from = 0.1, to = 100, points = 9223372036854775807 }}\n"
                ),
            ),
            (
                "many cells",
                format!(
                    "{base}[table]\ninterference = [1, 2]\nslip_rate = [1]\ntolerance = 0.1\n\
                     max_cells = 9223372036854775807\n"
                ),
            ),
            ("a long axis", format!("{base}[table]\ninterference = [1]\nslip_rate = [{}]\n", rising(300_000))),
        ],
        _ => vec![(
            "many pressures",
            format!(
                "[surface]\nasperity_density = 1e10\nasperity_radius = 1e-4\n\
                 heights = {{ distribution = \"gaussian\", std = 1e-6 }}\n\
                 [query]\npressure = [{}]\nslip_rate = [1.0]\n",
                (1..300_000).map(|n| format!("{n}.0,")).collect::<String>()
            ),
        )],
    }
}
