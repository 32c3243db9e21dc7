// Charts, by dygraphs where it was installed when the page was made.

const cursorInk = "#b30059";

function withoutCharts(host) {
  host.textContent = "Charts need Debian's package libjs-dygraphs where the report is made.";
}

/** Unit of a column of history.csv behind its label: " (km²)". */
function unitIn(name) {
  const unit = columnUnit(name).word;
  return unit ? ` (${unit})` : "";
}

/** What numbers of a column are told in, by the largest: word, and how many of the column's unit that is. */
function columnUnit(name) {
  const largest = Math.max(...page.runs.flatMap(run => run.history[name] || []).filter(Number.isFinite).map(Math.abs), 0);
  const [scale, word] = scaleOf(largest, page.data.measures[name]?.[1]);
  return {scale, word};
}

/** Column of history.csv that ascends: extension, with stages of motion the travel. */
function clockOf(run) { return "travel_m" in run.history ? "travel_m" : "extension_m"; }

function clockWord(run) { return clockOf(run) === "travel_m" ? "travel" : "extension"; }

/** Measures of history.csv against extension, or the travel, with a cursor at the moment that is shown. */
class HistoryChart {
  constructor(host, runs, show) {
    this.host = host;
    this.runs = runs;
    this.show = show;
    this.at = 0;
  }

  /** Clocks of runs are rounded to it, m, so that their rows meet: a plain part of the finest interval. */
  clockStep() {
    const clocks = this.runs.map(run => run.history[clockOf(run)] || []);
    const intervals = clocks.flatMap(clock => clock.slice(1).map((travel, k) => travel - clock[k])).filter(interval => interval > 0);
    return Math.min(10 ** Math.floor(Math.log10(Math.min(...intervals) / 40)), 10);
  }

  /** Rows of the clock in the page's unit, the first measure of each run, the second of each run. */
  rows(names) {
    const marks = new Map(), step = this.clockStep(), scales = names.map(name => columnUnit(name).scale);
    this.runs.forEach((run, r) => {
      (run.history[clockOf(run)] || []).forEach((travel, k) => {
        const key = Math.round(travel / step);
        if (!marks.has(key)) marks.set(key, new Array(names.length * this.runs.length).fill(null));
        names.forEach((name, n) => {
          const value = (run.history[name] || [])[k];
          marks.get(key)[n * this.runs.length + r] = Number.isFinite(value) ? value / scales[n] : null;
        });
      });
    });
    return [...marks.entries()].sort((a, b) => a[0] - b[0]).map(([key, values]) => [key * step / lengthUnit().metres, ...values]);
  }

  draw(names) {
    if (typeof Dygraph === "undefined") return withoutCharts(this.host);
    const of = r => this.runs.length > 1 ? `, ${"AB"[r]}` : "";
    const labels = names.flatMap((name, n) => this.runs.map((_, r) => `${wordsOf(name)}${unitIn(name)}${of(r)}${n && name === names[0] ? " " : ""}`));
    const series = {}, unit = lengthUnit(), clock = `${clockWord(this.runs[0])} (${unit.name})`;
    labels.slice(this.runs.length).forEach(label => { series[label] = {axis: "y2"}; });
    this.chart?.destroy();
    this.chart = new Dygraph(this.host, this.rows(names), {
      labels: [clock, ...labels], series, connectSeparatedPoints: true, drawPoints: true, pointSize: 2,
      strokeWidth: 1.6, colors: ["#1f77a8", "#c96a00", "#5f9fc4", "#d9a066"], axisLineColor: "#8a8a8a", gridLineColor: "#8a8a8a55", xlabel: clock,
      labelsUTC: true, digitsAfterDecimal: 3, axes: {y2: {drawGrid: false, independentTicks: true}},
      underlayCallback: (context, area, chart) => {
        const column = chart.toDomXCoord(this.at / unit.metres);
        context.fillStyle = cursorInk;
        context.fillRect(column - 1, area.y, 2, area.h);
      },
      clickCallback: (_, x) => this.show(unit.metres * x),
    });
  }

  moveTo(travel) {
    this.at = travel;
    this.chart?.updateOptions({});
  }
}

/** A chart of plain rows, drawn anew. */
function drawPlain(host, rows, labels, options) {
  if (typeof Dygraph === "undefined") return withoutCharts(host);
  host.textContent = "";
  if (rows.length === 0) return void (host.textContent = "Nothing to draw.");
  new Dygraph(host, rows, {labels, connectSeparatedPoints: true, drawPoints: true, pointSize: 2.5,
    strokeWidth: 1.6, colors: ["#1f77a8", "#c96a00", "#5f9fc4"], axisLineColor: "#8a8a8a", gridLineColor: "#8a8a8a55", digitsAfterDecimal: 1, ...options});
}

function throwsOf(fault) {
  return Object.keys(fault).map(key => key.match(/^throw_(-?\d+)_m$/)).filter(Boolean)
    .map(match => [Number(match[1]), fault[match[0]], fault[`throw_${match[1]}_error_m`]]).filter(([, value]) => value !== null)
    .sort((a, b) => a[0] - b[0]);
}
