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

  // From numbers to parts of an axis, 0 at its start and 1 at its end, for all finite numbers: uPlot itself knows increments of 1e-32 to 1e32 only.
  const ZERO_PART = 0.08;
  class Axis {
    constructor(least, greatest, log, numbers) {
      const magnitudes = numbers.filter((value) => value !== null && value !== 0).map(Math.abs);
      Object.assign(this, { least, greatest, log: log && magnitudes.length > 0 });
      this.most = Math.max(Math.abs(least), Math.abs(greatest)) || 1;
      if (!this.log) return;
      this.hasNegative = numbers.some((value) => value < 0);
      this.low = Math.log10(Math.max(magnitudes.reduce((a, b) => Math.min(a, b)) / 2, 5e-324));
      this.high = Math.max(Math.log10(this.most), this.low + 1);
    }

    part(value) {
      if (value === null || value === undefined) return value;
      if (!this.log) return (value / this.most - this.least / this.most) / (this.greatest / this.most - this.least / this.most);
      const size = Math.abs(value);
      const above = size === 0 ? -1 : (Math.log10(size) - this.low) / (this.high - this.low);
      const from = above < 0 ? (size === 0 ? 0 : ZERO_PART * Math.min(1, size / 10 ** this.low)) : ZERO_PART + (1 - ZERO_PART) * above;
      return this.hasNegative ? 0.5 + (value < 0 ? -from : from) / 2 : value < 0 ? 0 : from;
    }

    value(part) {
      if (!this.log) return (this.least / this.most + part * (this.greatest / this.most - this.least / this.most)) * this.most;
      const from = this.hasNegative ? Math.abs(part - 0.5) * 2 : part;
      const size = from <= ZERO_PART ? 0 : 10 ** (this.low + (from - ZERO_PART) / (1 - ZERO_PART) * (this.high - this.low));
      return this.hasNegative && part < 0.5 ? -size : size;
    }

    // Round numbers between two parts, about so many.
    ticks(first, last, most) {
      const [a, b] = [this.value(Math.max(first, 0)), this.value(Math.min(last, 1))];
      let found = [];
      if (!this.log) {
        const rough = (b / most - a / most) || this.most / most;
        let exponent = Math.floor(Math.log10(rough));
        const digits = rough / Number("1e" + exponent);
        let step = digits <= 1 ? 1 : digits <= 2 ? 2 : digits <= 5 ? 5 : 10;
        if (step === 10) { step = 1; exponent += 1; }
        const unit = Number(step + "e" + exponent);
        const [from, to] = [Math.ceil(a / unit - 1e-9), Math.floor(b / unit + 1e-9)];
        if (!(to - from < 100)) return [a, b];
        for (let multiple = from; multiple <= to; multiple++) found.push(Number(multiple * step + "e" + exponent));
      } else {
        const decades = [];
        const step = [1, 2, 3, 5, 10, 20, 50, 100, 200].find((step) => (this.high - this.low) / step <= most) || 200;
        for (let power = Math.floor(this.low); power <= this.high; power++) if (power % step === 0) decades.push(Number("1e" + power));
        found = [...(this.hasNegative ? decades.map((value) => -value).reverse() : []), 0, ...decades];
      }
      return found.filter((value) => { const part = this.part(value); return Number.isFinite(value) && part >= first - 1e-9 && part <= last + 1e-9; });
    }
  }

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
      const { x: across, y: up } = this.axes[side];
      return { x, parts: [x.map((value) => across.part(value)), ...series.map((of) => of.map((value) => up.part(value)))] };
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

    draw() {
      this.plots.forEach((plot) => plot && plot.destroy());
      const width = Math.max(this.area.clientWidth || this.figure.clientWidth - 30, 300);
      const { halves } = this.data;
      const scaled = halves.map((half) => half.scaled);
      const part = scaled[0] && scaled[1] ? 0.5 : scaled[0] ? 0.84 : 0.16;
      const left = 84;
      const widths = [left + (width - left) * part, (width - left) * (1 - part)];
      const ys = this.data.curves.flatMap((curve) => curve.sides.flatMap((of) => of.y));
      const up = new Axis(...this.range(), this.log.y, ys);
      this.axes = halves.map((half) => ({ x: new Axis(half.start, half.end, this.log.x && half.scaled, half.rows), y: up }));
      this.plots = SIDES.map((_, side) => this.plot(side, widths[side]));
    }

    plot(side, width) {
      const half = this.data.halves[side];
      const { x: abscissae, parts } = this.columns(side);
      const count = this.data.curves.length;
      const text = style("--text"), grid = { stroke: style("--fine"), width: 1 };
      const font = "12px 'DejaVu Sans', Verdana, sans-serif";
      const series = [{}];
      this.data.curves.forEach((curve, index) => {
        const line = { stroke: colour(index, count), width: 2, show: this.shown[index], spanGaps: false };
        const knots = new Set(curve.sides[side].knots);
        const chosen = abscissae.flatMap((x, place) => knots.has(x) ? [place] : []);
        series.push({ ...line, points: { show: true, size: 7, fill: colour(index, count), filter: () => chosen } });
        series.push({ ...line, dash: [5, 4], points: { show: false } });
      });
      if (this.probing) series.push({ stroke: text, width: 3, spanGaps: true, points: { show: false } });
      // At contact both sides have the same zero: the right one says it.
      const isDouble = side === 0 && this.data.halves[1].scaled;
      const marks = (of, most, isLabelled) => {
        const labels = new Map();
        return {
          splits: (plot, _, first, last) => of.ticks(first, last, most).map((value) => {
            const part = of.part(value);
            labels.set(part, isLabelled(value) ? number(value) : "");
            return part;
          }),
          values: (_, splits) => splits.map((split) => labels.get(split) || ""),
        };
      };
      const { x: across, y: up } = this.axes[side];
      const axis = { stroke: text, grid, ticks: grid, font, labelFont: font };
      const none = { values: (_, splits) => splits.map(() => ""), ticks: { show: false } };
      const scale = { time: false, auto: false, range: (_, least, greatest) => least === null || least === greatest ? [0, 1] : [least, greatest] };
      const node = this.area.appendChild(element("div"));
      const made = new uPlot({
        width, height: 340, legend: { show: false }, padding: [14, side === 0 ? 0 : 14, 0, side === 0 ? 0 : 2],
        cursor: { y: false, drag: { x: true, y: false }, points: { size: 9 } },
        focus: { prox: -1 },
        scales: {
          x: { ...scale, dir: side === 0 ? -1 : 1 },
          y: { ...scale, range: () => [0, 1] },
        },
        axes: [
          half.scaled ? { ...axis, ...marks(across, Math.max(width / 75, 2), (value) => !(isDouble && value === 0)), label: half.title, labelSize: 22 } : { ...axis, ...none, label: SIDES[side], labelSize: 22, grid: { show: false } },
          side === 0 ? { ...axis, ...marks(up, 7, () => true), label: this.data.value, size: 62, labelSize: 22 } : { ...axis, splits: marks(up, 7, () => true).splits, ...none, size: 0, side: 3 },
        ],
        series,
        hooks: {
          setCursor: [(plot) => { if (plot.cursor.idx !== null && plot.cursor.idx !== undefined && plot.cursor.left >= 0) this.read({ side, index: plot.cursor.idx }); }],
          draw: [(plot) => this.overlay(plot, side)],
        },
      }, parts, node);
      made.abscissae = abscissae;
      return made;
    }

    // Contact, the rows of the node table and the findings.
    overlay(plot, side) {
      const { ctx, bbox } = plot;
      const { x: across, y: up } = this.axes[side];
      const place = (x, y) => [plot.valToPos(across.part(x), "x", true), plot.valToPos(up.part(y), "y", true)];
      ctx.save();
      ctx.strokeStyle = style("--quiet");
      ctx.lineWidth = devicePixelRatio;
      ctx.setLineDash([]);
      const contact = Math.round(plot.valToPos(across.part(this.data.halves[side].start), "x", true)) + (side === 0 ? -0.5 : 0.5);
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
      const x = this.plots[side].abscissae[index];
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
        if (index < 0 && plot(1 - side).abscissae.length) { side = 1 - side; index = 0; }
        index = Math.min(Math.max(index, 0), plot(side).abscissae.length - 1);
        const left = plot(side).valToPos(plot(side).data[0][index], "x");
        this.read({ side, index });
        plot(side).setCursor({ left, top: 10 }, false);
      };
      const zoom = (factor) => {
        const { side } = at;
        const { min, max } = plot(side).scales.x;
        const middle = this.cursor ? plot(side).data[0][this.cursor.index] : (min + max) / 2;
        plot(side).setScale("x", { min: middle - (middle - min) * factor, max: middle + (max - middle) * factor });
      };
      const keys = { ArrowLeft: () => move(-1), ArrowRight: () => move(1), "+": () => zoom(0.5), "-": () => zoom(2), 0: () => this.draw() };
      if (keys[event.key]) { event.preventDefault(); keys[event.key](); }
    }
  }

  const charts = [];
  const make = (figure) => {
    if (figure.inpact) return;
    try {
      charts.push(new Chart(figure));
    } catch (error) {
      // Its drawing stays.
      figure.querySelector(".chart").replaceChildren();
      console.error(error);
    }
  };
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
