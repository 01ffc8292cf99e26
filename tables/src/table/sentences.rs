//! Sentences about many places in a few lines: those that differ in their numbers only become one, with the range of each
//! number; and those about several initial temperatures.

use crate::numbers::plain;

/// Every sentence once, with the initial temperature (K) that it concerns unless these are all.
pub fn by_temperature(of_temperatures: &[(Option<f64>, &[String])]) -> Vec<String> {
    let mut sentences: Vec<String> = Vec::new();
    for (temperature, own) in of_temperatures {
        for sentence in *own {
            let concerns_all = of_temperatures.iter().all(|(_, other)| other.contains(sentence));
            let text = match temperature {
                Some(temperature) if !concerns_all => format!("at {} K: {sentence}", plain(*temperature)),
                _ => sentence.clone(),
            };
            if !sentences.contains(&text) {
                sentences.push(text);
            }
        }
    }
    sentences
}

/// A sentence and the places that it is about.
pub struct Sentence {
    words: Vec<String>,
    /// Smallest and largest of each number between the words, as written.
    numbers: Vec<[String; 2]>,
    /// Places that the sentence is about, in the order in which they were added.
    pub places: Vec<(usize, usize)>,
    stands_alone: bool,
}

/// One sentence for all that differ in their numbers only, in the order of the first of each.
pub fn condensed(sentences: impl IntoIterator<Item = Sentence>) -> Vec<Sentence> {
    let mut found: Vec<Sentence> = Vec::new();
    for sentence in sentences {
        if !found.iter_mut().any(|known| known.absorbs(&sentence)) {
            found.push(sentence);
        }
    }
    found
}

impl Sentence {
    /// A sentence about one place.
    pub fn new(text: &str, place: (usize, usize)) -> Self {
        let (words, numbers) = split(text);
        Self {
            words,
            numbers: numbers.into_iter().map(|number| [number.clone(), number]).collect(),
            places: vec![place],
            stands_alone: false,
        }
    }

    /// Whether another one of its words is about something else, not about another place.
    pub fn standing_alone(self, stands_alone: bool) -> Self {
        Self { stands_alone, ..self }
    }

    /// Takes another one in, if its words are the same and neither stands alone.
    pub fn absorbs(&mut self, other: &Sentence) -> bool {
        if self.stands_alone || other.stands_alone || self.words != other.words {
            return false;
        }
        let value = |text: &str| text.parse::<f64>().unwrap_or(f64::NAN);
        for ([low, high], [number, _]) in self.numbers.iter_mut().zip(&other.numbers) {
            if value(number) < value(low) {
                low.clone_from(number);
            }
            if value(number) > value(high) {
                high.clone_from(number);
            }
        }
        self.places.extend_from_slice(&other.places);
        true
    }

    /// Text with the ranges of its numbers; of those "up to" a number the largest.
    pub fn text(&self) -> String {
        let ranges = self.numbers.iter().zip(&self.words).map(|([low, high], before)| {
            match low == high || before.ends_with("up to ") {
                true => high.clone(),
                false => format!("{low} to {high}"),
            }
        });
        let ranges = ranges.chain([String::new()]);
        self.words.iter().zip(ranges).map(|(words, range)| format!("{words}{range}")).collect()
    }
}

/// The text between the numbers, one piece more than these, and the numbers. Digits within a name are no number.
fn split(text: &str) -> (Vec<String>, Vec<String>) {
    let (mut words, mut numbers) = (vec![String::new()], Vec::new());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let in_name =
            words.last().is_some_and(|word| word.ends_with(|c: char| c.is_alphanumeric() || c == '_'));
        // Of a range, "1-2", the sign is no part of the second number.
        let in_range = numbers.len() + 1 == words.len() && words.last().is_some_and(String::is_empty);
        let unsigned =
            if in_range && !numbers.is_empty() { rest } else { rest.strip_prefix('-').unwrap_or(rest) };
        let sign = rest.len() - unsigned.len();
        let digits = unsigned.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(unsigned.len());
        // The full stop of a sentence is none of it.
        let mantissa = unsigned[..digits].trim_end_matches('.').len();
        let number = &rest[..sign + mantissa + exponent(&unsigned[mantissa..])];
        if in_name || number.parse::<f64>().is_err() {
            words.last_mut().expect("not empty").push(first);
            rest = &rest[first.len_utf8()..];
        } else {
            numbers.push(number.to_owned());
            words.push(String::new());
            rest = &rest[number.len()..];
        }
    }
    (words, numbers)
}

/// Length of an exponent that a text begins with, as of 2e-5.
fn exponent(text: &str) -> usize {
    let power = text.strip_prefix('e').map(|power| power.strip_prefix('-').unwrap_or(power));
    let digits =
        power.map_or(0, |power| power.len() - power.trim_start_matches(|c: char| c.is_ascii_digit()).len());
    match power {
        Some(power) if digits > 0 => text.len() - power.len() + digits,
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_that_differ_in_numbers_become_one() {
        let mut sentence = Sentence::new("mu_2 is 2.1 %, above 2.0 % at 4340.", (0, 0));
        assert!(sentence.absorbs(&Sentence::new("mu_2 is 10.3 %, above 2.0 % at 4340.", (0, 1))));
        assert!(sentence.absorbs(&Sentence::new("mu_2 is 1.9 %, above 2.0 % at 4340.", (2, 0))));
        assert!(!sentence.absorbs(&Sentence::new("mu_3 is 1.9 %, above 2.0 % at 4340.", (0, 0))));
        assert_eq!(sentence.text(), "mu_2 is 1.9 to 10.3 %, above 2.0 % at 4340.");
        assert_eq!(sentence.places, [(0, 0), (0, 1), (2, 0)]);
        assert!(!Sentence::new("1-2", (0, 0)).absorbs(&Sentence::new("1 -2", (0, 0))));
    }

    /// Of upper limits the largest is stated; signs and exponents belong to their numbers.
    #[test]
    fn numbers_become_ranges() {
        for (texts, expected) in [
            (&["up to 14.34 % of 2 loads", "up to 14.28 % of 3 loads"][..], "up to 14.34 % of 2 to 3 loads"),
            (&["at -1e-7 m", "at -2e-7 m", "at 3e-7 m"], "at -2e-7 to 3e-7 m"),
            (
                &["2e-5 of work, 3 of heat is missing", "4e-6 of work, 1e2 of heat is missing"],
                "4e-6 to 2e-5 of work, 3 to 1e2 of heat is missing",
            ),
        ] {
            let mut sentence = Sentence::new(texts[0], (0, 0));
            assert!(
                texts[1..].iter().all(|text| sentence.absorbs(&Sentence::new(text, (0, 0)))),
                "{texts:?}"
            );
            assert_eq!(sentence.text(), expected);
        }
    }

    #[test]
    fn texts_without_numbers_stay() {
        for text in ["the flat melts", "", "σ is 3", "7 cells: 1.5.", "v1.2.3", "2e", "3e-", "1em"] {
            assert_eq!(Sentence::new(text, (0, 0)).text(), text);
        }
    }
}
