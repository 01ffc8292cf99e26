//! A page as SVG. Texts stay texts.

use std::fmt::Write;

use super::canvas::{Anchor, Color, Mark, Page, Point, runs};

/// Fonts, of which a viewer takes the first that it has.
const FONTS: &str = "DejaVu Sans, Verdana, Arial, Helvetica, sans-serif";

pub(super) fn svg(page: &Page) -> String {
    let (width, height) = (number(page.width), number(page.height));
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}pt\" height=\"{height}pt\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"{FONTS}\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
    );
    for group in &page.groups {
        let (name, at) = (escaped(&group.name), pair(group.at));
        let _ = writeln!(svg, "<g class=\"{name}\" transform=\"translate({at})\">");
        for mark in &group.marks {
            draw(&mut svg, mark);
        }
        svg.push_str("</g>\n");
    }
    svg.push_str("</svg>\n");
    svg
}

fn draw(svg: &mut String, mark: &Mark) {
    let _ = match mark {
        Mark::Fill { outlines, color, seam } => {
            let outlines: String = outlines.iter().map(|outline| path(outline) + "Z").collect();
            let color = hex(*color);
            let seam = match *seam > 0.0 {
                true => format!(" stroke=\"{color}\" stroke-width=\"{seam}\" stroke-linejoin=\"round\""),
                false => String::new(),
            };
            writeln!(svg, "<path d=\"{outlines}\" fill=\"{color}\"{seam}/>")
        }
        Mark::Line { points, color, width, dashes } => {
            let dashes: Vec<String> = dashes.iter().map(|length| number(*length)).collect();
            let dashes = match dashes.is_empty() {
                true => String::new(),
                false => format!(" stroke-dasharray=\"{}\"", dashes.join(" ")),
            };
            let (path, color) = (path(points), hex(*color));
            writeln!(
                svg,
                "<path d=\"{path}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" \
                 stroke-linejoin=\"round\"{dashes}/>"
            )
        }
        Mark::Text { at, text, size, anchor } => {
            let placed = match anchor {
                Anchor::Start => String::new(),
                Anchor::Middle => " text-anchor=\"middle\"".into(),
                Anchor::End => " text-anchor=\"end\"".into(),
                Anchor::Upwards => format!(" text-anchor=\"middle\" transform=\"rotate(-90 {})\"", pair(*at)),
            };
            let (x, y) = (number(at.0), number(at.1));
            let content = spans(text, *size);
            writeln!(svg, "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\"{placed}>{content}</text>")
        }
    };
}

/// The parts of a text; those above or below its line as spans.
fn spans(text: &str, size: f64) -> String {
    let (mut spans, mut level) = (String::new(), 0.0);
    for run in runs(text) {
        let text = escaped(&run.text);
        let _ = match run.rise == level && run.scale == 1.0 {
            true => write!(spans, "{text}"),
            false => {
                let (lower, size) = (number(size * (level - run.rise)), number(size * run.scale));
                write!(spans, "<tspan dy=\"{lower}\" font-size=\"{size}\">{text}</tspan>")
            }
        };
        level = run.rise;
    }
    spans
}

fn path(points: &[Point]) -> String {
    let mut path = String::new();
    for (n, point) in points.iter().enumerate() {
        let _ = write!(path, "{}{}", if n == 0 { "M" } else { "L" }, pair(*point));
    }
    path
}

fn pair((x, y): Point) -> String {
    format!("{} {}", number(x), number(y))
}

/// To a hundredth of a point.
fn number(value: f64) -> String {
    format!("{}", (value * 100.0).round() / 100.0 + 0.0)
}

fn hex([red, green, blue]: Color) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// A text as content of XML or HTML.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
