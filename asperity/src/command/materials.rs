//! `asperity materials`: the presets and their sources.

use std::fmt::Write;

use asperity::numbers;
use asperity::presets::{self, Preset};
use serde_json::json;

use super::{Display, Failure, print};

/// List the presets, or print one with every constant.
pub fn materials(name: Option<&str>, display: &Display) -> Result<(), Failure> {
    let chosen: Vec<&Preset> = match name {
        None => presets::all().iter().collect(),
        Some(name) => vec![presets::find(name).ok_or_else(|| unknown(name))?],
    };
    if display.json {
        let all: Vec<_> = chosen.iter().map(|preset| as_json(preset)).collect();
        let value = match name {
            None => json!(all),
            Some(_) => all[0].clone(),
        };
        print(&format!("{value:#}\n"));
        return Ok(());
    }
    let text = match name {
        None => chosen.iter().map(|preset| format!("{:16}{}\n", preset.name, preset.title)).collect(),
        Some(_) => constants(chosen[0]),
    };
    print(&text);
    Ok(())
}

fn unknown(name: &str) -> Failure {
    let names = presets::names().join(", ");
    Failure::input(format!("materials {name}: no such preset; there are {names}"))
}

fn constants(preset: &Preset) -> String {
    let mut text = format!("{}: {}\n", preset.name, preset.title);
    // Writing to a String cannot fail.
    for (group, law) in &preset.laws {
        let _ = writeln!(text, "{group}: {law}");
    }
    for constant in &preset.constants {
        let _ = writeln!(
            text,
            "{:22}{:>10} {:9} {}",
            constant.key,
            numbers::plain(constant.value),
            constant.unit,
            constant.source
        );
    }
    text
}

fn as_json(preset: &Preset) -> serde_json::Value {
    let constants: serde_json::Map<_, _> = preset
        .constants
        .iter()
        .map(|c| {
            let entry = json!({ "value": c.value, "unit": c.unit, "source": c.source });
            (c.key.clone(), entry)
        })
        .collect();
    let laws: serde_json::Map<_, _> =
        preset.laws.iter().map(|(group, law)| (group.clone(), json!(law))).collect();
    json!({
        "name": preset.name,
        "title": preset.title,
        "laws": laws,
        "constants": constants,
    })
}
