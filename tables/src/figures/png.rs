//! A page as PNG.

use ttf_parser::OutlineBuilder;
use zeno::{Cap, Command, Join, Mask, PathBuilder, Stroke, Style, Transform, Vector};

use super::canvas::{Anchor, BLACK, Color, FACE, Mark, Page, Point, advance, glyph, indent, runs};

/// Pixels per point: 300 per inch.
const PIXELS: f64 = 300.0 / 72.0;

/// Pixels, red, green and blue each.
struct Image {
    width: usize,
    height: usize,
    bytes: Vec<u8>,
}

pub(super) fn png(page: &Page) -> std::io::Result<Vec<u8>> {
    let [width, height] = [page.width, page.height].map(|length| (length * PIXELS).ceil() as usize);
    let mut image = Image { width, height, bytes: vec![255; 3 * width * height] };
    for group in &page.groups {
        for mark in &group.marks {
            image.draw(mark, group.at);
        }
    }
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgb);
    let pixels_per_metre = (PIXELS * 72.0 / 0.0254).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: pixels_per_metre,
        yppu: pixels_per_metre,
        unit: png::Unit::Meter,
    }));
    encoder.write_header()?.write_image_data(&image.bytes)?;
    Ok(file)
}

impl Image {
    fn draw(&mut self, mark: &Mark, (left, top): Point) {
        let placed = |(x, y): &Point| Vector::new(((left + x) * PIXELS) as f32, ((top + y) * PIXELS) as f32);
        let path = |points: &[Point]| {
            let mut commands = Vec::new();
            for (n, point) in points.iter().map(placed).enumerate() {
                if n == 0 {
                    commands.move_to(point)
                } else {
                    commands.line_to(point)
                };
            }
            commands
        };
        match mark {
            Mark::Fill { outlines, color, seam } => {
                let mut commands = Vec::new();
                for outline in outlines {
                    commands.extend(path(outline));
                    commands.close();
                }
                self.cover(&commands, Style::default(), *color);
                if *seam > 0.0 {
                    self.cover(&commands, Stroke::new((seam * PIXELS) as f32), *color);
                }
            }
            Mark::Line { points, color, width, dashes } => {
                let lengths: Vec<f32> = dashes.iter().map(|length| (length * PIXELS) as f32).collect();
                let mut stroke = Stroke::new((width * PIXELS) as f32);
                stroke.cap(Cap::Butt).join(Join::Round).dash(&lengths, 0.0);
                self.cover(&path(points), stroke, *color);
            }
            Mark::Text { at, text, size, anchor } => {
                self.cover(&outlines(placed(at), text, *size, *anchor), Style::default(), BLACK);
            }
        }
    }

    /// Lays a colour over what a path covers.
    fn cover<'a>(&mut self, path: &[Command], style: impl Into<Style<'a>>, color: Color) {
        let (mask, place) = Mask::new(path).style(style).render();
        for (n, share) in mask.iter().enumerate().filter(|(_, share)| **share > 0) {
            let x = place.left + (n % place.width as usize) as i32;
            let y = place.top + (n / place.width as usize) as i32;
            if (0..self.width as i32).contains(&x) && (0..self.height as i32).contains(&y) {
                let pixel = 3 * (y as usize * self.width + x as usize);
                for (below, above) in self.bytes[pixel..pixel + 3].iter_mut().zip(color) {
                    let (share, above) = (u16::from(*share), u16::from(above));
                    *below = ((u16::from(*below) * (255 - share) + above * share + 127) / 255) as u8;
                }
            }
        }
    }
}

/// Outlines of the letters of a text.
fn outlines(at: Vector, text: &str, size: f64, anchor: Anchor) -> Vec<Command> {
    let angle = if anchor == Anchor::Upwards { 90.0 } else { 0.0 };
    let turned = Transform::rotation(zeno::Angle::from_degrees(angle)).then_translate(at.x, at.y);
    let (mut commands, mut x) = (Vec::new(), indent(text, size, anchor));
    for run in runs(text) {
        let size_of_run = size * run.scale;
        let scale = (size_of_run * PIXELS / f64::from(FACE.units_per_em())) as f32;
        for character in run.text.chars() {
            let mut letter = Letter(Vec::new());
            FACE.outline_glyph(glyph(character), &mut letter);
            let placed = Transform::scale(scale, -scale)
                .then_translate((x * PIXELS) as f32, (-size * run.rise * PIXELS) as f32)
                .then(&turned);
            commands.extend(letter.0.iter().map(|command| command.transform(&placed)));
            x += size_of_run * advance(character);
        }
    }
    commands
}

/// Outline of a letter in the units of the font.
struct Letter(Vec<Command>);

impl OutlineBuilder for Letter {
    fn move_to(&mut self, x: f32, y: f32) {
        self.0.move_to([x, y]);
    }
    fn line_to(&mut self, x: f32, y: f32) {
        self.0.line_to([x, y]);
    }
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.0.quad_to([x1, y1], [x, y]);
    }
    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.0.curve_to([x1, y1], [x2, y2], [x, y]);
    }
    fn close(&mut self) {
        self.0.close();
    }
}
