// Charts of the report. Data: element "data"; library: uPlot.
(() => {
  "use strict";
  const data = JSON.parse(document.getElementById("data").textContent);
  const element = (name) => document.getElementById(name);
  const colours = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"];
  const number = (value) => (value == null ? "n/a" : String(Number(value.toPrecision(5))));
  const labels = {
    pressure: data.loads.map((value) => `${number(value)} ${data.load_unit}`),
    rate: data.slip_rates.map((value) => `${number(value)} m/s`),
  };
  const choice = element("quantity");
  data.quantities.forEach((quantity) => choice.add(new Option(`${quantity.name}: ${quantity.long_name}`, quantity.name)));

  // A box for each pressure and each slip rate; those that are on.
  const boxes = (kind) =>
    labels[kind].map((label) => {
      const box = document.createElement("input");
      box.type = "checkbox";
      box.checked = true;
      box.addEventListener("change", draw);
      const line = document.createElement("label");
      line.append(box, ` ${label}`);
      element(kind).append(line);
      return box;
    });
  const switches = { pressure: boxes("pressure"), rate: boxes("rate") };
  const on = (kind) => labels[kind].map((_, index) => index).filter((index) => switches[kind][index].checked);

  // Lines over x; the legend shows the values under the pointer, dragging zooms, a double click shows all again.
  function chart(name, x, label, lines) {
    const holder = element(name);
    holder.replaceChildren();
    const drawn = x.values.map((_, index) => index).filter((index) => !x.logarithmic || x.values[index] > 0);
    const axis = { values: (_, ticks) => ticks.map((tick) => (tick == null ? "" : number(tick))) };
    const series = lines.map((line, index) => ({
      label: line.label,
      stroke: colours[index % colours.length],
      value: (_, value) => number(value),
      points: { show: drawn.length < 40 },
    }));
    // Exactly what was dragged over; one value alone has the range of the library around it.
    const around = (low, high) => (x.logarithmic ? uPlot.rangeLog(low, high, 10, true) : uPlot.rangeNum(low, high, 0.1, true));
    const range = (_, low, high) => (low < high || low == null ? [low, high] : around(low, high));
    const options = {
      width: Math.max(320, Math.min(holder.clientWidth || 900, 1100)),
      height: 360,
      scales: { x: { time: false, distr: x.logarithmic ? 3 : 1, range } },
      axes: [{ ...axis, label: x.label }, { ...axis, label, size: 90 }],
      series: [{ label: x.label, value: (_, value) => number(value) }, ...series],
    };
    const columns = [x.values, ...lines.map((line) => line.values)].map((column) => drawn.map((index) => column[index]));
    new uPlot(options, columns, holder);
    copies[name] = [[x.label, ...lines.map((line) => line.label)], ...drawn.map((_, row) => columns.map((column) => column[row] ?? ""))];
  }

  const copies = {};
  function draw() {
    const quantity = data.quantities.find((one) => one.name === choice.value);
    const label = `${quantity.name} [${quantity.unit}]`;
    const rates = { values: data.slip_rates, label: "slip rate [m/s]", logarithmic: true };
    const loads = { values: data.loads, label: `${data.load} [${data.load_unit}]`, logarithmic: data.load_unit === "Pa" };
    chart("over-rate", rates, label, on("pressure").map((row) => ({ label: labels.pressure[row], values: quantity.values[row] })));
    chart("over-load", loads, label, on("rate").map((rate) => ({ label: labels.rate[rate], values: quantity.values.map((row) => row[rate]) })));
    const pairs = on("pressure").flatMap((row) => on("rate").map((rate) => [row, rate]));
    const slides = pairs.map(([row, rate]) => ({ label: `${labels.pressure[row]}, ${labels.rate[rate]}`, values: data.mu_history[row][rate] }));
    chart("over-slip", { values: data.slip, label: "slip [m]", logarithmic: true }, "mu along the slide [1]", slides);
  }

  // The numbers of a chart as columns separated by tabs, in a field that is selected, and on the clipboard.
  document.querySelectorAll("button[data-chart]").forEach((button) =>
    button.addEventListener("click", () => {
      const field = element("numbers");
      field.value = copies[button.dataset.chart].map((row) => row.join("\t")).join("\n");
      field.hidden = false;
      field.select();
      document.execCommand("copy");
    })
  );
  choice.addEventListener("change", draw);
  draw();
})();
