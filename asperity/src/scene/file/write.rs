//! A scene or a request written back as complete TOML, with every default filled in.

use std::fmt::Write;

use super::request::Request;
use crate::interface::friction_law::Value;
use crate::scene::{
    Control, FractureData, Hardening, InterfaceStrength, Kinematics, Scene, Softening, Switch,
    TemperatureTable,
};

/// The whole scene as TOML; reading it gives the same scene.
pub fn write_scene(scene: &Scene) -> String {
    let loading = &scene.loading;
    let point = format!(
        "interference = {}\nslip_rate = {}\n",
        number(loading.interference),
        number(loading.slip_rate)
    );
    sections(scene, &point)
}

/// The whole request as TOML; reading it gives the same request.
pub fn write_request(request: &Request) -> String {
    let mut text = sections(&request.template, "");
    let _ = write!(
        text,
        "\n[table]\ninterference = {}\nslip_rate = {}\n",
        list(&request.interferences),
        list(&request.slip_rates)
    );
    if !request.temperatures.is_empty() {
        let _ = writeln!(text, "temperature = {}", list(&request.temperatures));
    }
    if let Some(goal) = request.goal {
        let _ = write!(text, "tolerance = {}\nmax_cells = {}\n", number(goal.tolerance), goal.most_cells);
    }
    text
}

fn sections(scene: &Scene, point: &str) -> String {
    let material = &scene.material;
    let interface = &scene.interface;
    let mut text = String::new();
    // Writing to a String cannot fail.
    let mut line = |key: &str, value: String| {
        let _ = match value.as_str() {
            "" => writeln!(text, "{key}"),
            value => writeln!(text, "{key} = {value}"),
        };
    };
    line("[material]", String::new());
    let tables = &material.dependence;
    line("youngs_modulus", property(material.youngs_modulus, &tables.youngs_modulus));
    line("poisson_ratio", number(material.poisson_ratio));
    line("yield_strength", number(material.yield_strength));
    line("hardening", hardening(&material.hardening));
    line("density", number(material.density));
    line("specific_heat", property(material.specific_heat, &tables.specific_heat));
    line("thermal_conductivity", property(material.thermal_conductivity, &tables.thermal_conductivity));
    line("thermal_expansion", property(material.thermal_expansion, &tables.thermal_expansion));
    line("softening", softening(&material.softening));
    match material.fracture {
        None => {}
        Some(FractureData::Energy(energy)) => line("shear_fracture_energy", number(energy)),
        Some(FractureData::Toughness(toughness)) => line("fracture_toughness_mode_ii", number(toughness)),
        Some(FractureData::Tensile { strength, uniform_elongation }) => {
            line("tensile_strength", number(strength));
            line("uniform_elongation", number(uniform_elongation));
        }
    }
    line("\n[asperity]", String::new());
    line("radius", number(scene.radius));
    line("\n[interface]", String::new());
    line("law", quoted(interface.law.name()));
    for (parameter, value) in interface.law.parameters() {
        line(
            parameter.key,
            match value {
                Value::Number(value) => number(value),
                Value::Flag(flag) => flag.to_string(),
            },
        );
    }
    line("strength", strength(interface.strength));
    line("strength_factor", number(interface.strength_factor));
    line("heat_partition", number(interface.heat_partition));
    line("gap_conductance", number(interface.gap_conductance));
    line("taylor_quinney", number(interface.taylor_quinney));
    line("\n[loading]", String::new());
    for given in point.lines() {
        line(given, String::new());
    }
    line("slip_distance", number(scene.loading.slip_distance));
    line("control", control(scene.loading.control));
    line("temperature", number(scene.loading.temperature));
    line("\n[model]", String::new());
    line("heat", switch(scene.model.heat));
    line("kinematics", kinematics(scene.model.kinematics));
    line("\n[numerics]", String::new());
    line("accuracy", number(scene.numerics.accuracy));
    if let Some(count) = scene.numerics.elements_per_radius {
        line("elements_per_radius", count.to_string());
    }
    if let Some(count) = scene.numerics.sectors {
        line("sectors", count.to_string());
    }
    text
}

/// Shortest text that reads back as the same number.
fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0.0".into(),
        1e-3..1e5 => format!("{value:?}"),
        _ => format!("{value:e}"),
    }
}

fn list(values: &[f64]) -> String {
    let numbers: Vec<String> = values.iter().map(|&value| number(value)).collect();
    format!("[{}]", numbers.join(", "))
}

/// The number, or the table that it is taken from.
fn property(value: f64, table: &Option<TemperatureTable>) -> String {
    match table {
        None => number(value),
        Some(TemperatureTable { temperature, value }) => {
            format!("{{ temperature = {}, value = {} }}", list(temperature), list(value))
        }
    }
}

fn hardening(law: &Hardening) -> String {
    match law {
        Hardening::None => "{ law = \"none\" }".into(),
        Hardening::Linear { modulus } => {
            format!("{{ law = \"linear\", modulus = {} }}", number(*modulus))
        }
        Hardening::JohnsonCook { modulus, exponent } => format!(
            "{{ law = \"johnson-cook\", modulus = {}, exponent = {} }}",
            number(*modulus),
            number(*exponent)
        ),
        Hardening::Table { plastic_strain, factor } => format!(
            "{{ law = \"table\", plastic_strain = {}, factor = {} }}",
            list(plastic_strain),
            list(factor)
        ),
    }
}

fn softening(law: &Softening) -> String {
    match law {
        Softening::None => "{ law = \"none\" }".into(),
        Softening::JohnsonCook { reference, melting, exponent } => format!(
            "{{ law = \"johnson-cook\", reference = {}, melting = {}, exponent = {} }}",
            number(*reference),
            number(*melting),
            number(*exponent)
        ),
        Softening::Table { temperature, factor } => {
            format!("{{ law = \"table\", temperature = {}, factor = {} }}", list(temperature), list(factor))
        }
    }
}

fn quoted(name: &str) -> String {
    format!("\"{name}\"")
}

fn strength(strength: InterfaceStrength) -> String {
    quoted(match strength {
        InterfaceStrength::Initial => "initial",
        InterfaceStrength::Current => "current",
    })
}

fn control(control: Control) -> String {
    quoted(match control {
        Control::Interference => "interference",
        Control::Load => "load",
    })
}

fn switch(switch: Switch) -> String {
    quoted(match switch {
        Switch::Auto => "auto",
        Switch::On => "on",
        Switch::Off => "off",
    })
}

fn kinematics(kinematics: Kinematics) -> String {
    quoted(match kinematics {
        Kinematics::Auto => "auto",
        Kinematics::Small => "small",
        Kinematics::Finite => "finite",
    })
}
