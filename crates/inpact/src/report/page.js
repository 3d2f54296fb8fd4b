"use strict";
// Makes the charts of a report: data comes from the JSON beside each figure, and every number in it is one that inpact computed.
(() => {
  const html = document.documentElement;
  html.classList.add("js");
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const style = (name) => getComputedStyle(html).getPropertyValue(name).trim();
  // The ramp of the pictures; on a dark ground its lighter end is where it begins.
  const RAMP = [[13, 8, 135], [70, 3, 159], [114, 1, 168], [156, 23, 158], [189, 55, 134], [216, 87, 107], [237, 121, 83]];
  const DARK = [[122, 162, 255], [160, 160, 255], [200, 150, 250], [230, 150, 220], [245, 160, 180], [250, 180, 130], [250, 210, 100]];
  const colour = (index, count) => {
    const ramp = dark.matches ? DARK : RAMP;
    const place = count < 2 ? (dark.matches ? 0 : 0.4) : index / (count - 1) * (ramp.length - 1);
    const from = Math.min(Math.floor(place), ramp.length - 2);
    return "rgb(" + ramp[from].map((part, i) => Math.round(part + (place - from) * (ramp[from + 1][i] - part))).join(",") + ")";
  };
  const number = (value) => {
    if (value === null || value === undefined) return "none";
    const size = Math.abs(value);
    if (size === 0 || (size >= 1e-3 && size < 1e5)) return String(value);
    return value.toExponential().replace("e+", "e");
  };
  const element = (name, text, attributes) => {
    const made = document.createElement(name);
    if (text) made.textContent = text;
    for (const [key, value] of Object.entries(attributes || {})) made.setAttribute(key, value);
    return made;
  };
  const SIDES = ["open", "closed"];

  class Chart {
    constructor(figure) {
      this.figure = figure;
      this.data = JSON.parse(figure.querySelector("script").textContent);
      this.shown = this.data.curves.map(() => true);
      this.log = { x: false, y: false };
      this.stops = (this.data.probe ? this.data.probe.axes : []).map(() => 0);
      this.probing = false;
      this.cursor = null;
      this.plots = [null, null];
      const box = figure.querySelector(".chart");
      this.tools = box.appendChild(element("div", "", { class: "tools" }));
      this.area = box.appendChild(element("div", "", { class: "plots", tabindex: "0", role: "group", "aria-label": "Curves; arrow keys read values, plus and minus zoom, 0 shows all" }));
      this.output = box.appendChild(element("output", "", { "aria-live": "polite" }));
      this.legend = box.appendChild(element("div", "", { class: "legend", role: "group", "aria-label": "Which curves are shown" }));
      this.makeTools();
      this.makeLegend();
      this.area.addEventListener("keydown", (event) => this.key(event));
      this.draw();
      figure.classList.add("live");
      figure.inpact = this;
    }

    makeTools() {
      const toggle = (words, axis) => {
        const button = this.tools.appendChild(element("button", words, { type: "button", "aria-pressed": "false" }));
        button.addEventListener("click", () => {
          this.log[axis] = !this.log[axis];
          button.setAttribute("aria-pressed", String(this.log[axis]));
          this.draw();
        });
      };
      toggle("Logarithmic values", "y");
      toggle("Logarithmic clearance and pressure", "x");
      this.tools.appendChild(element("button", "Show all", { type: "button" })).addEventListener("click", () => this.draw());
      if (!this.data.probe) return;
      this.data.probe.axes.forEach((axis, index) => {
        const label = this.tools.appendChild(element("label", axis.title + " "));
        const slider = label.appendChild(element("input", "", { type: "range", min: "0", max: String(axis.stops.length - 1), step: "1", value: "0", "data-axis": axis.column }));
        const shown = label.appendChild(element("span", number(axis.stops[0])));
        slider.setAttribute("aria-valuetext", number(axis.stops[0]));
        slider.addEventListener("input", () => {
          this.stops[index] = Number(slider.value);
          const at = number(axis.stops[this.stops[index]]);
          shown.textContent = at;
          slider.setAttribute("aria-valuetext", at);
          this.probing = true;
          this.draw();
          this.read(this.cursor);
        });
      });
    }

    makeLegend() {
      const { curves, family } = this.data;
      if (family) this.legend.appendChild(element("span", family + ":"));
      curves.forEach((curve, index) => {
        if (curve.at === null) return;
        const button = this.legend.appendChild(element("button", "", { type: "button", "aria-pressed": "true" }));
        const swatch = button.appendChild(element("span", "", { class: "swatch" }));
        swatch.style.background = colour(index, curves.length);
        button.appendChild(document.createTextNode(number(curve.at)));
        button.addEventListener("click", () => {
          this.shown[index] = !this.shown[index];
          button.setAttribute("aria-pressed", String(this.shown[index]));
          this.plots.forEach((plot) => plot && [1, 2].forEach((part) => plot.setSeries(2 * index + part, { show: this.shown[index] })));
        });
      });
    }

    // The values of the law at the stops of the sliders.
    probed(side) {
      const { axes, branches } = this.data.probe;
      let stop = 0;
      axes.forEach((axis, index) => { stop = stop * axis.stops.length + this.stops[index]; });
      const of = branches[side];
      return of.x.map((_, index) => of.y[stop * of.x.length + index]);
    }

    // All numbers of one side over common abscissae: each curve twice, where its table has rows and where it is continued.
    columns(side) {
      const half = this.data.halves[side];
      let x = half.x;
      const series = this.data.curves.flatMap((curve) => {
        const { y, continued } = curve.sides[side];
        const isContinued = (index) => continued[index] === 1;
        const within = y.map((value, index) => isContinued(index) ? null : value);
        const beyond = y.map((value, index) => isContinued(index) || isContinued(index - 1) || isContinued(index + 1) ? value : null);
        return [within, beyond];
      });
      if (this.probing) {
        const probe = this.data.probe.branches[side];
        const values = new Map(this.probed(side).map((value, index) => [probe.x[index], value]));
        const all = [...new Set([...x, ...probe.x])].sort((a, b) => a - b);
        const place = new Map(x.map((value, index) => [value, index]));
        for (let index = 0; index < series.length; index++) {
          const of = series[index];
          series[index] = all.map((value) => place.has(value) ? of[place.get(value)] : undefined);
        }
        series.push(all.map((value) => values.has(value) ? values.get(value) : undefined));
        x = all;
      }
      return [x, ...series];
    }

    range() {
      const values = this.data.curves.flatMap((curve) => curve.sides.flatMap((side) => side.y)).concat(this.data.nodes ? this.data.nodes.flatMap((of) => of.y) : []);
      if (this.data.probe && this.probing) values.push(...this.data.probe.branches.flatMap((of) => of.y));
      let [least, greatest] = [0, 0];
      for (const value of values) if (value !== null) { least = Math.min(least, value); greatest = Math.max(greatest, value); }
      if (least === greatest) greatest = 1;
      const room = greatest / 20 - least / 20;
      return [least === 0 ? 0 : Math.max(least - room, -Number.MAX_VALUE), Math.min(greatest + room, Number.MAX_VALUE)];
    }

    // Below this magnitude a logarithmic axis is linear.
    threshold(values) {
      let least = Infinity;
      for (const value of values) if (value !== null && value !== 0) least = Math.min(least, Math.abs(value));
      return least === Infinity ? 1 : least;
    }

    draw() {
      this.plots.forEach((plot) => plot && plot.destroy());
      const width = Math.max(this.area.clientWidth || this.figure.clientWidth - 30, 300);
      const { halves } = this.data;
      const scaled = halves.map((half) => half.scaled);
      const part = scaled[0] && scaled[1] ? 0.5 : scaled[0] ? 0.84 : 0.16;
      const left = 84;
      const widths = [left + (width - left) * part, (width - left) * (1 - part)];
      this.bounds = this.range();
      this.plots = SIDES.map((_, side) => this.plot(side, widths[side]));
    }

    plot(side, width) {
      const half = this.data.halves[side];
      const columns = this.columns(side);
      const count = this.data.curves.length;
      const text = style("--text"), grid = { stroke: style("--fine"), width: 1 };
      const font = "12px 'DejaVu Sans', Verdana, sans-serif";
      const series = [{}];
      this.data.curves.forEach((curve, index) => {
        const line = { stroke: colour(index, count), width: 2, show: this.shown[index], spanGaps: false };
        const knots = new Set(curve.sides[side].knots);
        const chosen = columns[0].flatMap((x, place) => knots.has(x) ? [place] : []);
        series.push({ ...line, points: { show: true, size: 7, fill: colour(index, count), filter: () => chosen } });
        series.push({ ...line, dash: [5, 4], points: { show: false } });
      });
      if (this.probing) series.push({ stroke: text, width: 3, spanGaps: true, points: { show: false } });
      const values = (_, splits) => splits.map((split) => split === null ? "" : number(Number(split.toPrecision(12))));
      // At contact both sides have the same zero: the right one says it.
      const isDouble = side === 0 && this.data.halves[1].scaled;
      const abscissae = (plot, splits) => splits.map((split) => split === null || (isDouble && split === 0) ? "" : number(Number(split.toPrecision(12))));
      const axis = { stroke: text, grid, ticks: grid, font, labelFont: font, values };
      const scale = (log, numbers, fixed) => log ? { time: false, distr: 4, asinh: this.threshold(numbers), range: () => fixed } : { time: false, auto: false, range: (_, least, greatest) => least === null || least === greatest ? fixed : [least, greatest] };
      const ys = this.data.curves.flatMap((curve) => curve.sides.flatMap((of) => of.y));
      const node = this.area.appendChild(element("div"));
      const made = new uPlot({
        width, height: 340, legend: { show: false }, padding: [14, side === 0 ? 0 : 14, 0, side === 0 ? 0 : 2],
        cursor: { y: false, drag: { x: true, y: false }, points: { size: 9 } },
        focus: { prox: -1 },
        scales: {
          x: { ...scale(this.log.x, half.x, [half.start, half.end]), dir: side === 0 ? -1 : 1 },
          y: { ...scale(this.log.y, ys, this.bounds), range: () => this.bounds },
        },
        axes: [
          half.scaled ? { ...axis, label: half.title, space: 60, labelSize: 22, values: abscissae } : { ...axis, label: SIDES[side], values: (_, splits) => splits.map(() => ""), labelSize: 22, grid: { show: false }, ticks: { show: false } },
          side === 0 ? { ...axis, label: this.data.value, size: 62, labelSize: 22 } : { ...axis, show: true, size: 0, values: (_, splits) => splits.map(() => ""), ticks: { show: false }, side: 3 },
        ],
        series,
        hooks: {
          setCursor: [(plot) => { if (plot.cursor.idx !== null && plot.cursor.idx !== undefined && plot.cursor.left >= 0) this.read({ side, index: plot.cursor.idx }); }],
          draw: [(plot) => this.overlay(plot, side)],
        },
      }, columns, node);
      made.columns = columns;
      return made;
    }

    // Contact, the rows of the node table and the findings.
    overlay(plot, side) {
      const { ctx, bbox } = plot;
      const place = (x, y) => [plot.valToPos(x, "x", true), plot.valToPos(y, "y", true)];
      ctx.save();
      ctx.strokeStyle = style("--quiet");
      ctx.lineWidth = devicePixelRatio;
      ctx.setLineDash([]);
      const contact = Math.round(plot.valToPos(0, "x", true)) + (side === 0 ? -0.5 : 0.5);
      if (contact >= bbox.left - 1 && contact <= bbox.left + bbox.width + 1) {
        ctx.beginPath();
        ctx.moveTo(contact, bbox.top);
        ctx.lineTo(contact, bbox.top + bbox.height);
        ctx.stroke();
      }
      ctx.beginPath();
      ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
      ctx.clip();
      if (this.data.nodes) {
        ctx.fillStyle = style("--text");
        ctx.globalAlpha = 0.35;
        const { x, y } = this.data.nodes[side];
        x.forEach((at, index) => {
          const [left, top] = place(at, y[index]);
          ctx.fillRect(left - 1.5 * devicePixelRatio, top - 1.5 * devicePixelRatio, 3 * devicePixelRatio, 3 * devicePixelRatio);
        });
        ctx.globalAlpha = 1;
      }
      ctx.font = "bold " + 12 * devicePixelRatio + "px sans-serif";
      ctx.textAlign = "center";
      for (const mark of this.data.marks.filter((mark) => mark.side === side)) {
        const [left, top] = place(mark.x, mark.y);
        ctx.strokeStyle = ctx.fillStyle = style("--" + mark.severity);
        ctx.lineWidth = 2 * devicePixelRatio;
        ctx.beginPath();
        ctx.arc(left, top, 9 * devicePixelRatio, 0, 7);
        ctx.stroke();
        ctx.fillText(mark.code, left, top - 14 * devicePixelRatio);
      }
      ctx.restore();
    }

    // The values at the abscissa under the cursor, as inpact computed them.
    read(cursor) {
      if (!cursor || !this.plots[cursor.side]) return;
      this.cursor = cursor;
      const { side, index } = cursor;
      const half = this.data.halves[side];
      const x = this.plots[side].columns[0][index];
      const lines = [(half.scaled ? half.column + " " + number(x) : SIDES[side]) + ":"];
      const place = half.x.indexOf(x);
      this.data.curves.forEach((curve, number_) => {
        if (!this.shown[number_] || place < 0) return;
        const { y, knots, rows } = curve.sides[side];
        const row = knots.indexOf(x);
        const name = curve.at === null ? this.data.column : this.data.family_column + " " + number(curve.at);
        lines.push(name + " = " + number(y[place]) + (row < 0 ? "" : " (row " + (rows[row] + 1) + ")"));
      });
      if (this.probing) {
        const { axes, branches } = this.data.probe;
        const at = branches[side].x.indexOf(x);
        const stops = axes.map((axis, axisIndex) => axis.column + " " + number(axis.stops[this.stops[axisIndex]]));
        if (at >= 0) lines.push("sliders, " + stops.join(", ") + " = " + number(this.probed(side)[at]));
      }
      this.output.textContent = lines.join("  ");
    }

    key(event) {
      const plot = (side) => this.plots[side];
      const at = this.cursor || { side: 1, index: -1 };
      const move = (by) => {
        // To the right on the open side is towards contact.
        let { side, index } = at;
        index += side === 0 ? -by : by;
        if (index < 0 && plot(1 - side).columns[0].length) { side = 1 - side; index = 0; }
        index = Math.min(Math.max(index, 0), plot(side).columns[0].length - 1);
        const left = plot(side).valToPos(plot(side).columns[0][index], "x");
        this.read({ side, index });
        plot(side).setCursor({ left, top: 10 }, false);
      };
      const zoom = (factor) => {
        const { side } = at;
        const { min, max } = plot(side).scales.x;
        const middle = this.cursor ? plot(side).columns[0][this.cursor.index] : (min + max) / 2;
        plot(side).setScale("x", { min: middle - (middle - min) * factor, max: middle + (max - middle) * factor });
      };
      const keys = { ArrowLeft: () => move(-1), ArrowRight: () => move(1), "+": () => zoom(0.5), "-": () => zoom(2), 0: () => this.draw() };
      if (keys[event.key]) { event.preventDefault(); keys[event.key](); }
    }
  }

  const charts = [];
  const make = (figure) => { if (!figure.inpact) { charts.push(new Chart(figure)); } };
  const figures = [...document.querySelectorAll("figure.law[data-live]")];
  const seen = new IntersectionObserver((entries) => entries.forEach((entry) => {
    if (entry.isIntersecting) { seen.unobserve(entry.target); make(entry.target); }
  }), { rootMargin: "300px" });
  figures.forEach((figure) => seen.observe(figure));
  dark.addEventListener("change", () => charts.forEach((chart) => chart.draw()));
  // What is folded away is printed as well.
  let opened = [];
  addEventListener("beforeprint", () => { opened = [...document.querySelectorAll("details:not([open])")]; opened.forEach((details) => { details.open = true; }); });
  addEventListener("afterprint", () => { opened.forEach((details) => { details.open = false; }); });
  let waiting = 0;
  addEventListener("resize", () => { clearTimeout(waiting); waiting = setTimeout(() => charts.forEach((chart) => chart.draw()), 150); });
})();
