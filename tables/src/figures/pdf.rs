//! A page as PDF 1.4, with its font embedded; texts can be searched.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;

use super::canvas::{Anchor, Color, FACE, FONT, Mark, Page, Point, advance, glyph, indent, runs};
use super::svg::number;

pub(super) fn pdf(page: &Page) -> std::io::Result<Vec<u8>> {
    let (content, characters) = content(page);
    let widths: String = (characters.iter())
        .map(|character| format!("{} [{}] ", glyph(*character).0, number(1000.0 * advance(*character))))
        .collect();
    let per_em = 1000.0 / f64::from(FACE.units_per_em());
    let scaled = |units: i16| number(per_em * f64::from(units));
    let bounds = FACE.global_bounding_box();
    let bounds = [bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max].map(scaled).join(" ");
    let objects = [
        b"<< /Type /Catalog /Pages 2 0 R >>".to_vec(),
        b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>".to_vec(),
        format!(
            "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {} {}] /Contents 4 0 R \
             /Resources << /Font << /F 5 0 R >> >> >>",
            number(page.width),
            number(page.height)
        )
        .into_bytes(),
        stream(content.as_bytes(), "")?,
        b"<< /Type /Font /Subtype /Type0 /BaseFont /AAAAAA+DejaVuSans /Encoding /Identity-H \
          /DescendantFonts [6 0 R] /ToUnicode 9 0 R >>"
            .to_vec(),
        format!(
            "<< /Type /Font /Subtype /CIDFontType2 /BaseFont /AAAAAA+DejaVuSans /CIDToGIDMap /Identity \
             /CIDSystemInfo << /Registry (Adobe) /Ordering (Identity) /Supplement 0 >> \
             /FontDescriptor 7 0 R /W [{widths}] >>"
        )
        .into_bytes(),
        format!(
            "<< /Type /FontDescriptor /FontName /AAAAAA+DejaVuSans /Flags 4 /FontBBox [{bounds}] \
             /ItalicAngle 0 /Ascent {} /Descent {} /CapHeight 729 /StemV 80 /FontFile2 8 0 R >>",
            scaled(FACE.ascender()),
            scaled(FACE.descender())
        )
        .into_bytes(),
        stream(FONT, &format!("/Length1 {} ", FONT.len()))?,
        stream(to_unicode(&characters).as_bytes(), "")?,
    ];
    file(&objects)
}

/// The objects, numbered from 1, with the table of their places.
fn file(objects: &[Vec<u8>]) -> std::io::Result<Vec<u8>> {
    // Four bytes above 127 tell transfer programs that the file is binary.
    let mut file = b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n".to_vec();
    let mut places = String::new();
    for (n, object) in objects.iter().enumerate() {
        let _ = writeln!(places, "{:010} 00000 n ", file.len());
        writeln!(file, "{} 0 obj", n + 1)?;
        file.extend(object);
        file.extend(b"\nendobj\n");
    }
    let (start, count) = (file.len(), objects.len() + 1);
    write!(file, "xref\n0 {count}\n0000000000 65535 f \n{places}")?;
    write!(file, "trailer\n<< /Size {count} /Root 1 0 R >>\nstartxref\n{start}\n%%EOF\n")?;
    Ok(file)
}

fn stream(content: &[u8], entries: &str) -> std::io::Result<Vec<u8>> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(content)?;
    let packed = encoder.finish()?;
    let head = format!("<< {entries}/Length {} /Filter /FlateDecode >>\nstream\n", packed.len());
    Ok([head.as_bytes(), &packed, b"\nendstream"].concat())
}

/// What is drawn, and its characters.
fn content(page: &Page) -> (String, BTreeSet<char>) {
    let (mut content, mut characters) = (String::new(), BTreeSet::new());
    for group in &page.groups {
        // Upwards in a PDF.
        let placed = |(x, y): &Point| (group.at.0 + x, page.height - group.at.1 - y);
        for mark in &group.marks {
            match mark {
                Mark::Fill { outlines, color, seam } => {
                    let outlines: String =
                        outlines.iter().map(|outline| path(outline.iter().map(placed)) + "h ").collect();
                    let color = components(*color);
                    let _ = match *seam > 0.0 {
                        true => writeln!(content, "{color} rg {color} RG {seam} w 1 j [] 0 d {outlines}B"),
                        false => writeln!(content, "{color} rg {outlines}f"),
                    };
                }
                Mark::Line { points, color, width, dashes } => {
                    let dashes: Vec<String> = dashes.iter().map(|length| number(*length)).collect();
                    let (color, path) = (components(*color), path(points.iter().map(placed)));
                    let _ = writeln!(content, "{color} RG {width} w 1 j [{}] 0 d {path}S", dashes.join(" "));
                }
                Mark::Text { at, text, size, anchor } => {
                    content.push_str("0 0 0 rg\n");
                    write_text(&mut content, placed(at), text, *size, *anchor);
                    characters.extend(runs(text).iter().flat_map(|run| run.text.chars()));
                }
            }
        }
    }
    (content, characters)
}

fn path(points: impl Iterator<Item = Point>) -> String {
    let mut path = String::new();
    for (n, (x, y)) in points.enumerate() {
        let _ = write!(path, "{} {} {} ", number(x), number(y), if n == 0 { "m" } else { "l" });
    }
    path
}

fn components(color: Color) -> String {
    color.map(|part| format!("{:.3}", f64::from(part) / 255.0)).join(" ")
}

fn write_text(content: &mut String, (x, y): Point, text: &str, size: f64, anchor: Anchor) {
    let mut along = indent(text, size, anchor);
    for run in runs(text) {
        let glyphs: String = run.text.chars().map(|c| format!("{:04x}", glyph(c).0)).collect();
        let rise = size * run.rise;
        let (directions, x, y) = match anchor {
            Anchor::Upwards => ("0 1 -1 0", x - rise, y + along),
            _ => ("1 0 0 1", x + along, y + rise),
        };
        let (x, y, size) = (number(x), number(y), size * run.scale);
        let _ = writeln!(content, "BT /F {size} Tf {directions} {x} {y} Tm <{glyphs}> Tj ET");
        along += size * run.text.chars().map(advance).sum::<f64>();
    }
}

/// Characters of the glyphs, for search and copy.
fn to_unicode(characters: &BTreeSet<char>) -> String {
    let mut map = String::from(
        "/CIDInit /ProcSet findresource begin 12 dict begin begincmap\n\
         /CIDSystemInfo << /Registry (Adobe) /Ordering (UCS) /Supplement 0 >> def\n\
         /CMapName /Adobe-Identity-UCS def /CMapType 2 def\n\
         1 begincodespacerange <0000> <ffff> endcodespacerange\n",
    );
    let characters: Vec<char> = characters.iter().copied().collect();
    // A list has at most 100 lines.
    for part in characters.chunks(100) {
        let _ = writeln!(map, "{} beginbfchar", part.len());
        for character in part {
            let code: String =
                (character.encode_utf16(&mut [0; 2]).iter()).map(|unit| format!("{unit:04x}")).collect();
            let _ = writeln!(map, "<{:04x}> <{code}>", glyph(*character).0);
        }
        map.push_str("endbfchar\n");
    }
    map + "endcmap CMapName currentdict /CMap defineresource pop end end\n"
}
