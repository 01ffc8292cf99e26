use super::list::LIST;
use super::*;

#[test]
fn scalars_come_first_and_every_quantity_is_stored() {
    for (index, entry) in LIST.iter().enumerate() {
        assert_eq!(entry.scalar, index < Quantity::SCALARS.len(), "{}", entry.name);
        assert_eq!(Quantity::named(entry.name), Some(entry.quantity));
        assert!(entry.scalar || entry.history != Stored::No, "{} is stored nowhere", entry.name);
        assert_eq!(entry.scalar && entry.history != Stored::No, !entry.moment.is_empty(), "{}", entry.name);
    }
    use Quantity::*;
    assert_eq!(Quantity::TABLE_HISTORIES, [Mu, Friction, Load, Area, TemperatureMax]);
    assert_eq!(Quantity::PRESS_HISTORIES, [LoadPress, AreaPress, InterferencePress]);
}

#[test]
fn scaling_follows_from_the_unit() {
    for entry in &LIST {
        let exponent = match entry.units {
            "J" => 3,
            "N" | "m2" | "s" => 2,
            "m" | "J m-2" => 1,
            "m s-1" => -1,
            _ => 0,
        };
        assert_eq!(entry.radius_exponent, exponent, "{}", entry.name);
    }
}

#[test]
fn rows_are_pushed_and_compared() {
    let mut history = History::new(&Quantity::TABLE_HISTORIES);
    for row in 0..3 {
        history.push(|quantity| if quantity == Quantity::Load { f64::NAN } else { f64::from(row) });
    }
    assert_eq!((history.len(), history.last(Quantity::Mu)), (3, Some(2.0)));
    assert_eq!(history, history.clone());
    let mut shorter = history.clone();
    shorter.truncate(2);
    assert_ne!(history, shorter);
    shorter.column_mut(Quantity::Mu)[1] = 5.0;
    assert_eq!(shorter.column(Quantity::Mu), [0.0, 5.0]);
}
