"""Reproducible SVG plots: equal rows give equal bytes."""

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402  (after the backend is chosen)

plt.rcParams.update({"svg.hashsalt": "faqem", "svg.fonttype": "none", "font.size": 9,
                     "axes.spines.top": False, "axes.spines.right": False})


def save(figure, file):
    figure.tight_layout()
    figure.savefig(file, metadata={"Date": None, "Creator": None})
    plt.close(figure)


EDGE = 30  # ratios are clamped to [1 / EDGE, EDGE]


def per_mesh_ratios(file, series, title, measures):
    """Draws one panel per measure with a dot per mesh and a bar at the geometric mean. series: name -> against()."""
    names = list(series)
    figure, panels = plt.subplots(1, len(measures), figsize=(3.4 * len(measures), 0.9 + 0.3 * len(names)),
                                  sharey=True)
    for panel, (key, label) in zip(panels, measures):
        for y, name in enumerate(names):
            ours = name.startswith("faqem-")
            colour = "tab:blue" if ours else "tab:gray"
            values = [min(max(v[key], 1 / EDGE), EDGE) for v in series[name]["per_mesh"].values() if v[key] > 0]
            panel.scatter(values, [y] * len(values), s=9, color=colour, alpha=0.4, linewidths=0, clip_on=False)
            mean = series[name]["geomean"][key]
            if mean:
                panel.plot([mean, mean], [y - 0.35, y + 0.35], color=colour, linewidth=2.5)
        panel.set_xscale("log")
        panel.set_xlim(1 / EDGE, EDGE)
        panel.set_xticks([0.1, 1, 10], ["0.1", "1", "10"])
        panel.axvline(1, color="black", linewidth=0.6)
        panel.set_xlabel(label)
        panel.set_yticks(range(len(names)), names)
    panels[0].invert_yaxis()
    figure.suptitle(title)
    save(figure, file)


TICKS = [factor * 10**power for power in range(-4, 4) for factor in (1, 2, 5)]


def lines(file, panels, title, ylabel):
    """Draws one panel per entry of panels: name -> (labels, {line name -> values}). A legend is drawn if the names
    differ from those of the previous panel."""
    figure, axes = plt.subplots(1, len(panels), figsize=(2.9 * len(panels), 2.9), sharey=True, squeeze=False)
    named = None
    for axis, (name, (labels, curves)) in zip(axes[0], panels.items()):
        for curve, values in curves.items():
            points = [(x, y) for x, y in enumerate(values) if y]
            axis.plot([x for x, _ in points], [y for _, y in points], marker="o", label=curve)
        axis.set_xticks(range(len(labels)), labels)
        if max(map(len, labels)) > 5:
            axis.tick_params(axis="x", labelrotation=30)
        axis.set_yscale("log")
        axis.axhline(1, color="black", linewidth=0.6)
        axis.set_title(name)
        if named != list(curves):
            named = list(curves)
            axis.legend(fontsize=7)
    low, high = axes[0][0].get_ylim()
    axes[0][0].set_yticks([tick for tick in TICKS if low <= tick <= high])
    axes[0][0].yaxis.set_major_formatter("{x:g}")
    axes[0][0].yaxis.set_minor_formatter("")
    axes[0][0].set_ylabel(ylabel)
    figure.suptitle(title)
    save(figure, file)
