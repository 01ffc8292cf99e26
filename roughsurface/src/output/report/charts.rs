//! Charts that the reader of the report can change, drawn by uPlot (MIT, `uplot/LICENSE`).

use crate::friction::quantities::{QUANTITIES, SurfaceQuantity};
use crate::output::figure::chosen;
use crate::sampling::case::Results;
use crate::surface::query::NormalLoading;
use serde_json::{Value, json};
use tables::numbers;

const LIBRARY: &str = include_str!("uplot/uPlot.iife.min.js");
const LICENCE: &str = include_str!("uplot/LICENSE");
const CHARTS: &str = include_str!("charts.js");
/// Style sheet of the charts.
pub(super) const STYLE: &str = include_str!("uplot/uPlot.min.css");

/// Pressures and slip rates each: 256 slides of 200 slips have about 0.5 MB.
const MOST: usize = 16;

const CONTROLS: &str = "<h2>Charts</h2>\n\
<p>The boxes switch pressures and slip rates on and off, as do the entries of a legend, which show the values under the pointer. \
Dragging zooms, a double click shows the whole range again.</p>\n\
<p><label>Quantity <select id=\"quantity\"></select></label></p>\n\
<fieldset id=\"pressure\"><legend>Pressures or separations</legend></fieldset>\n\
<fieldset id=\"rate\"><legend>Slip rates</legend></fieldset>\n";

/// The charts, with their controls, data and scripts.
pub(super) fn html(results: &Results) -> String {
    let chart = |name: &str| {
        format!(
            "<div id=\"{name}\"></div>\n<p><button type=\"button\" data-chart=\"{name}\">Copy the numbers</button></p>\n"
        )
    };
    // A script ends at the first `</`, and the page is read as XML, too.
    let data =
        data(results).to_string().replace('<', "\\u003c").replace('&', "\\u0026").replace('>', "\\u003e");
    format!(
        "{CONTROLS}{}{}{}<textarea id=\"numbers\" rows=\"8\" cols=\"80\" readonly=\"readonly\" hidden=\"hidden\"></textarea>\n\
         <noscript><p>The charts need JavaScript; the figures below do not.</p></noscript>\n\
         <script type=\"application/json\" id=\"data\">{data}</script>\n\
         <script>\n//<![CDATA[\n/*\n{LICENCE}*/\n{LIBRARY}\n{CHARTS}//]]>\n</script>\n",
        chart("over-rate"),
        chart("over-load"),
        chart("over-slip")
    )
}

/// Five digits, as many as a reader sees; null for what is not finite.
fn rounded(value: f64) -> Value {
    json!(numbers::rounded(value, 5))
}

fn data(results: &Results) -> Value {
    let prediction = &results.prediction;
    let (loads, all_rates) = (prediction.query.loading.values(), &prediction.query.slip_rates);
    let (load, unit) = match prediction.query.loading {
        NormalLoading::Pressure(_) => ("pressure", "Pa"),
        NormalLoading::Separation(_) => ("separation before the slide", "m"),
    };
    let (rows, rates) = (chosen(loads.len(), MOST), chosen(all_rates.len(), MOST));
    let over = |value: &dyn Fn(usize, usize) -> Value| -> Value {
        rows.iter().map(|&row| rates.iter().map(|&rate| value(row, rate)).collect::<Value>()).collect()
    };
    let quantity = |quantity: &SurfaceQuantity| {
        let value =
            |row: usize, rate: usize| rounded(quantity.estimate(&prediction.friction[row][rate]).value);
        json!({"name": quantity.name, "long_name": quantity.long_name, "unit": quantity.unit, "values": over(&value)})
    };
    let history = |row: usize, rate: usize| {
        prediction.friction[row][rate].mu_history.iter().map(|mu| rounded(mu.value)).collect()
    };
    json!({
        "load": load,
        "load_unit": unit,
        "loads": rows.iter().map(|&row| loads[row]).collect::<Value>(),
        "slip_rates": rates.iter().map(|&rate| all_rates[rate]).collect::<Value>(),
        "slip": prediction.slip.iter().map(|slip| rounded(*slip)).collect::<Value>(),
        "quantities": QUANTITIES.iter().map(quantity).collect::<Value>(),
        "mu_history": over(&history),
    })
}
