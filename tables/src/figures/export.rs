//! A page as PNG and as PDF, from its SVG.

use std::io;
use std::sync::Arc;

use resvg::tiny_skia::{Pixmap, Transform};
use svg2pdf::usvg::{Options, Tree, fontdb};

use super::canvas::{FONT, Page};
use super::svg::svg;

/// Pixels per point: 300 per inch.
const PIXELS: f32 = 300.0 / 72.0;

pub(super) fn png(page: &Page) -> io::Result<Vec<u8>> {
    let [width, height] = [page.width, page.height].map(|length| (length as f32 * PIXELS).ceil() as u32);
    let mut image = Pixmap::new(width, height).ok_or_else(|| io::Error::other("an empty image"))?;
    // A unit of an SVG is a pixel of 1/96 inch: 3/4 of a point.
    resvg::render(&tree(page)?, Transform::from_scale(0.75 * PIXELS, 0.75 * PIXELS), &mut image.as_mut());
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(png::ColorType::Rgba);
    let pixels_per_metre = (PIXELS * 72.0 / 0.0254).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: pixels_per_metre,
        yppu: pixels_per_metre,
        unit: png::Unit::Meter,
    }));
    encoder.write_header()?.write_image_data(image.data())?;
    Ok(file)
}

/// Texts can be searched.
pub(super) fn pdf(page: &Page) -> io::Result<Vec<u8>> {
    let options = svg2pdf::PageOptions { dpi: 96.0 };
    svg2pdf::to_pdf(&tree(page)?, svg2pdf::ConversionOptions::default(), options)
        .map_err(|error| io::Error::other(error.to_string()))
}

/// The page with its texts as letters of the font of the program.
fn tree(page: &Page) -> io::Result<Tree> {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(FONT.to_vec());
    let options = Options { fontdb: Arc::new(fonts), ..Options::default() };
    Tree::from_str(&svg(page), &options).map_err(io::Error::other)
}
