//! `asperity materials`: the presets and their sources.

use asperity::scene::TemperatureTable;
use asperity::scene::presets::{self, ConstantValue, Preset};
use serde_json::{Value, json};
use tables::numbers;
use tables::quantity::hint;

use super::{Display, Failure};

/// List the presets, or print one with every constant.
pub fn materials(name: Option<&str>, display: &Display) -> Result<(), Failure> {
    let chosen: Vec<&Preset> = match name {
        None => presets::all().iter().collect(),
        Some(name) => vec![presets::find(name).ok_or_else(|| unknown(name))?],
    };
    let json = || match name {
        None => chosen.iter().map(|preset| as_json(preset)).collect(),
        Some(_) => as_json(chosen[0]),
    };
    let text = || match name {
        None => chosen.iter().map(|preset| format!("{:21}{}\n", preset.name, preset.title)).collect(),
        Some(_) => constants(chosen[0]),
    };
    display.printer().print(json, text)
}

fn unknown(name: &str) -> Failure {
    Failure::input(format!("materials {name}: unknown preset; {}", hint(name, &presets::names())))
}

fn constants(preset: &Preset) -> String {
    let mut text = format!("{}: {}\n", preset.name, preset.title);
    for (group, law) in &preset.laws {
        text += &format!("{group}: {law}\n");
    }
    for constant in &preset.constants {
        let value = match &constant.value {
            ConstantValue::Number(number) => numbers::plain(*number),
            ConstantValue::List(_) => "list".into(),
            ConstantValue::Table(_) => "table".into(),
        };
        text += &format!("{:24}{value:>10} {:9} {}\n", constant.key, constant.unit, constant.source);
        text += &points(&constant.value);
    }
    text + &format!("checked: {}\n", preset.checked)
}

/// The points of a list or table, a few to a line.
fn points(value: &ConstantValue) -> String {
    let (points, per_line): (Vec<String>, usize) = match value {
        ConstantValue::Number(_) => return String::new(),
        ConstantValue::List(numbers) => (numbers.iter().map(|&number| numbers::plain(number)).collect(), 12),
        ConstantValue::Table(TemperatureTable { temperature, value }) => {
            let point = |(t, v): (&f64, &f64)| format!("{} K: {}", numbers::plain(*t), numbers::plain(*v));
            (temperature.iter().zip(value).map(point).collect(), 5)
        }
    };
    points.chunks(per_line).map(|line| format!("    {}\n", line.join(", "))).collect()
}

fn as_json(preset: &Preset) -> Value {
    let constants: Value =
        preset.constants.iter().map(|constant| (constant.key.as_str(), json!(constant))).collect();
    let laws: Value = preset.laws.iter().map(|(group, law)| (group.as_str(), json!(law))).collect();
    json!({
        "name": preset.name,
        "title": preset.title,
        "checked": preset.checked,
        "laws": laws,
        "constants": constants,
    })
}
