//! A section checked against the list of its keys.

use tables::quantity::hint;
use toml::{Table, Value};

use super::error::SceneFileError;
use super::keys::{Key, Kind, NOT_NEGATIVE, Order, find, key};
use super::source::{Source, join};
use super::synonyms::meant;

/// Whether all keys of the section at `path` are among `keys`, taken by its law, and within their ranges.
pub fn check(path: &str, table: &Table, keys: &[Key], source: &Source) -> Result<(), SceneFileError> {
    let law = match (find(keys, "law"), table.get("law").and_then(Value::as_str)) {
        // Of an unknown law serde says so, not that a key is unknown or belongs to another.
        (Some(Kind::Law(laws)), Some(law)) if !laws().iter().any(|known| known == law) => return Ok(()),
        (Some(_), law) => law,
        (None, _) => None,
    };
    for name in table.keys() {
        if !keys.iter().any(|key| key.name == name) {
            let known: Vec<&str> = keys.iter().map(|key| key.name).collect();
            let full = join(path, name);
            return Err(SceneFileError::UnknownKey {
                location: source.location(&full),
                key: full,
                hint: match meant(path, name) {
                    // Sections of a surface file.
                    None if path.is_empty() && ["surface", "query"].contains(&name.as_str()) => {
                        "the file is one of a surface, for `roughsurface`; a scene has [material], [asperity] and [loading]".into()
                    }
                    Some(key) => format!("did you mean {key}? (known: {})", known.join(", ")),
                    None => hint(name, &known),
                },
            });
        }
    }
    for key in keys {
        let Some(value) = table.get(key.name) else {
            continue;
        };
        let full = join(path, key.name);
        if let Some(law) = law
            && !key.laws.is_empty()
            && !key.laws.contains(&law)
        {
            // Ignoring the key without a message would suggest that it is used.
            let takers: Vec<String> = key.laws.iter().map(|law| format!("law = {law:?}")).collect();
            return Err(source.invalid(&full, value, format!("left out unless {}", takers.join(" or "))));
        }
        check_value(&full, value, key.kind, source)?;
    }
    check_lengths(path, table, source)
}

fn check_value(path: &str, value: &Value, kind: Kind, source: &Source) -> Result<(), SceneFileError> {
    let good = match (kind, value) {
        (Kind::Section(keys), Value::Table(table)) => return check(path, table, keys, source),
        (Kind::Sections(keys), Value::Array(list)) => {
            for (n, value) in list.iter().enumerate() {
                check_value(&format!("{path}[{n}]"), value, Kind::Section(keys), source)?;
            }
            !list.is_empty()
        }
        (Kind::Property(unit, range), Value::Table(table)) => {
            let keys = [
                key("temperature", Kind::List("K", NOT_NEGATIVE, Order::NotFalling)),
                key("value", Kind::List(unit, range, Order::Any)),
            ];
            check(path, table, &keys, source)?;
            let missing = keys.iter().find(|key| !table.contains_key(key.name));
            return match missing {
                Some(key) => Err(source.missing(join(path, key.name), key.kind.allowed())),
                None => Ok(()),
            };
        }
        (Kind::NumberOr(_, _, name), Value::String(given)) => given == name,
        (Kind::Number(_, range) | Kind::NumberOr(_, range, _) | Kind::Property(_, range), value) => {
            as_number(value).is_some_and(|number| range.accepts(number))
        }
        (Kind::List(_, range, order), Value::Array(list)) => {
            let numbers: Option<Vec<f64>> = list.iter().map(as_number).collect();
            match numbers {
                Some(numbers) if !list.is_empty() && numbers.iter().all(|&x| range.accepts(x)) => {
                    return check_order(path, &numbers, order, source);
                }
                _ => false,
            }
        }
        (Kind::Count(from, to, step), value) => {
            let count = value.as_integer().and_then(|count| usize::try_from(count).ok());
            count.is_some_and(|count| (from..=to).contains(&count) && count % step == 0)
        }
        (Kind::Flag, value) => value.is_bool(),
        (Kind::Name | Kind::Law(_), _) => true,
        (Kind::Section(_) | Kind::Sections(_) | Kind::List(..), _) => false,
    };
    match good {
        true => Ok(()),
        false => Err(source.invalid(path, value, kind.allowed())),
    }
}

fn check_order(path: &str, numbers: &[f64], order: Order, source: &Source) -> Result<(), SceneFileError> {
    let (bad, allowed) = match order {
        Order::Any => return Ok(()),
        Order::Rising => (
            numbers.windows(2).find(|pair| pair[1] <= pair[0]),
            "a list that rises from each number to the next",
        ),
        Order::NotFalling => (
            (numbers.windows(2).find(|pair| pair[1] < pair[0]))
                .or(numbers.windows(3).find(|three| three[0] == three[2])),
            "a list that does not fall; two equal temperatures make a jump",
        ),
    };
    match bad {
        None => Ok(()),
        Some(bad) => Err(source.invalid(path, format!("[… {bad:?} …]"), allowed)),
    }
}

/// Laws and properties by points have as many ordinates as abscissae.
fn check_lengths(path: &str, table: &Table, source: &Source) -> Result<(), SceneFileError> {
    let length = |key: &str| table.get(key).and_then(Value::as_array).map(Vec::len);
    for (abscissa, ordinate) in
        [("plastic_strain", "factor"), ("temperature", "factor"), ("temperature", "value")]
    {
        if let (Some(wanted), Some(found)) = (length(abscissa), length(ordinate))
            && found != wanted
        {
            let allowed = format!("as long as {abscissa} ({wanted})");
            return Err(source.invalid(&join(path, ordinate), format!("{found} numbers"), allowed));
        }
    }
    Ok(())
}

/// Integers are numbers too: `interference = 20`.
pub fn as_number(value: &Value) -> Option<f64> {
    match value {
        Value::Float(number) => Some(*number),
        Value::Integer(number) => Some(*number as f64),
        _ => None,
    }
}
