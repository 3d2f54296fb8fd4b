"""What a long life brings: 10⁵ calls, threads that call at once, processes that begin as copies or anew."""

import hashlib
import multiprocessing
import pathlib
import threading

import numpy as np
import pyarrow as pa
import pytest
import random_decks

import inpact

CALLS = 100_000


def resident() -> int:
    """The bytes that the process holds now."""
    pages = int(pathlib.Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096


def memory_of_a_life() -> tuple[int, int]:
    """The bytes held after a tenth of 10⁵ calls of all kinds, and after all of them."""
    text, fields = random_decks.deck(np.random.default_rng(3))
    deck = inpact.parse(text)
    gap = deck.interactions["GAP"].electrical
    given = {"pressure": 10.0, "temperature": 300.0, "fv": [1.0] * fields}
    arrays = {**given, "pressure": np.linspace(0.0, 1e6, 16)}
    table = pa.table(random_decks.rows(np.random.default_rng(4), fields))

    def round_of(calls: int) -> None:
        for call in range(calls):
            kind = call % 100
            if kind < 70:
                gap.conductance(**given)
            elif kind < 90:
                gap.conductance(**arrays)
            elif kind < 99:
                inpact.parse(text).check()
            else:
                pa.table(inpact.evaluate(deck, table, threads=1))
        with pytest.raises(inpact.DeckError):
            inpact.evaluate(deck, {"clearance": ["wide"], "epot_jump": [1.0]}, outputs=["ECD"])

    # What is made once for all is made in the first tenth.
    round_of(CALLS // 10)
    before = resident()
    round_of(CALLS - CALLS // 10)
    return before, resident()


@pytest.mark.skipif(not pathlib.Path("/proc/self/statm").exists(), reason="there is no /proc")
def test_a_hundred_thousand_calls_leave_memory_where_it_is():
    # In a process of its own: what the threads of other tests left free is filled anew at any time.
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        before, after = pool.apply(memory_of_a_life)
    assert after - before < 8 << 20


def digest_of(seed: int) -> str:
    """What a process of its own gives for a deck and its rows, scalars and arrays."""
    random = np.random.default_rng(seed)
    text, fields = random_decks.deck(random)
    deck = inpact.parse(text)
    result = inpact.evaluate(deck, pa.table(random_decks.rows(random, fields)))
    gap = deck.interactions["GAP"].electrical
    others = {"temperature": 333.0, "fv": [2.0] * fields}
    pressures = np.linspace(0.0, 1.3e6, 200)
    text = hashlib.sha256()
    for name in result.column_names:
        text.update(np.asarray(result[name]).tobytes() if not isinstance(result[name], list) else b"")
    text.update(gap.conductance(pressure=pressures, **others).tobytes())
    text.update(np.float64(gap.conductance(pressure=5e5, **others)).tobytes())
    return text.hexdigest()


# Python warns that a copy of a process with threads may stand still; that it does not is what is tested here.
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_processes(method: str):
    if method not in multiprocessing.get_all_start_methods():
        pytest.skip(f"there is no {method} here")
    # The threads of this process have worked before it is copied.
    expected = [digest_of(seed) for seed in range(4)]
    with multiprocessing.get_context(method).Pool(2) as pool:
        found = pool.map_async(digest_of, range(4)).get(timeout=300)
    assert found == expected


def test_threads_that_call_at_once_agree():
    expected = [digest_of(seed) for seed in range(4)]
    found: list[list[str]] = []
    begin = threading.Barrier(8)

    def work() -> None:
        begin.wait()
        found.append([digest_of(seed) for _ in range(5) for seed in range(4)])

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [expected * 5] * 8
