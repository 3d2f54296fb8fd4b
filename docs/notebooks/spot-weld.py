# ---
# jupyter:
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
# ---

# %% [markdown]
# # A spot weld: from the deck to its curves to the heat of every node
#
# Two steel sheets between copper electrodes are squeezed, welded by a pulse of current and held.
# The deck `decks/spot-weld/spot-weld.inp` says how the current crosses the faying surface; a node table beside it says what pressure, temperature and potential the nodes had.
# This notebook reads the deck, draws the law, and finds the current through each node, the heat that it makes and the sum of both over time.
#
# `python docs/notebooks/make.py` runs it and writes `docs/notebooks/spot-weld.ipynb`; with `--check` it compares the numbers with those in that file instead.

# %%
import pathlib

import matplotlib.pyplot as plt
import numpy as np
import pyarrow.csv

import inpact

decks = next(folder / "decks" for folder in [pathlib.Path.cwd(), *pathlib.Path.cwd().parents] if (folder / "decks/spot-weld").is_dir())
deck = inpact.read(decks / "spot-weld/spot-weld.inp")
deck.check(), list(deck.interactions)

# %% [markdown]
# ## The law
#
# `FAYING` is the interaction of the two sheets.
# It has a table of conductance against contact pressure for closed nodes and one against clearance for open ones, both at several temperatures.

# %%
gap = deck.interactions["FAYING"].electrical
print(gap.tables, gap.depends_on)
print(gap.table("pressure").abscissae)

# %%
figure, (closed, open_) = plt.subplots(1, 2, figsize=(10, 4))
for temperature in [20.0, 400.0, 1000.0]:
    gap.plot("pressure", ax=closed, temperature=temperature)
    gap.plot("clearance", ax=open_, temperature=temperature)
for axes in (closed, open_):
    axes.legend(["20", "400", "1000"], title="temperature in °C")
figure.tight_layout()

# %% [markdown]
# Any number of points, with the slopes that a solver needs:

# %%
pressure = np.array([0.5e8, 1e8, 1.5e8])
values, slopes = gap.conductance(pressure=pressure, temperature=700.0, derivatives=True)
for p, value, slope in zip(pressure, values, slopes["pressure"]):
    print(f"p = {p:.1e} Pa: {value:.6e} S/m², along p {slope:.3e}")

# %% [markdown]
# ## The nodes
#
# Each row of the table is a node at a time, in the units of the deck.
# `evaluate` gives a row for each, in the same order; integrals over time follow each node.

# %%
nodes = pyarrow.csv.read_csv(decks / "spot-weld/spot-weld-nodes.csv")
result = inpact.evaluate(deck, nodes, outputs=["ECDA", "ECDTA", "SJDA", "SJDTA"])
print(nodes.num_rows, "rows in,", result.num_rows, "rows out:", ", ".join(result.column_names))
for finding in result.findings[:3]:
    print(finding)

# %% [markdown]
# ## Current and heat over time
#
# Sums over the nodes of each interface; the model is a quarter of the joint.

# %%
interactions = np.array(result["interaction"])
times = np.array(result["time"])
instants = np.unique(times)


def total(column, interaction):
    """The sum over the nodes of an interaction, at each time."""
    values = np.nan_to_num(result[column])
    return np.array([values[(interactions == interaction) & (times == instant)].sum() for instant in instants])


figure, (current, power, heat) = plt.subplots(1, 3, figsize=(13, 4))
for interaction in deck.interactions:
    current.plot(instants, np.abs(total("ECDA", interaction)), label=interaction)
    power.plot(instants, total("SJDA", interaction), label=interaction)
    heat.plot(instants, total("SJDTA", interaction), label=interaction)
for axes, name in [(current, "current in A"), (power, "heat rate in W"), (heat, "heat so far in J")]:
    axes.set_xlabel("time in s")
    axes.set_ylabel(name)
    axes.legend()
figure.tight_layout()

# %%
for interaction in deck.interactions:
    joules, peak = total("SJDTA", interaction)[-1], np.abs(total("ECDA", interaction)).max()
    print(f"{interaction}: {joules:.4f} J in all, at most {peak:.1f} A")

# %% [markdown]
# ## Where the heat goes
#
# The history of the hottest node of the faying surface: how its conductance grows with the temperature, and its heat with both.

# %%
everything = inpact.evaluate(deck, nodes, outputs=["conductance", "SJD", "SJDT"])
mine = interactions == "FAYING"
hottest = np.array(result["node"])[mine][np.argmax(everything["SJDT"][mine])]
rows = mine & (np.array(result["node"]) == hottest)
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4))
left.plot(times[rows], everything["conductance"][rows])
left.set(xlabel="time in s", ylabel="conductance in S/m²", title=f"node {hottest:.0f}")
right.plot(times[rows], everything["SJDT"][rows])
right.set(xlabel="time in s", ylabel="heat so far in J/m²")
figure.tight_layout()
print(f"node {hottest:.0f}: {everything['SJDT'][rows][-1]:.4e} J/m²")
