"""Evaluation past one machine: Parquet files by node block, one task a file.

A row with a history (ECDT, the heat of gap filling, …) needs the rows of its node before it, so that the unit of
work is a file that holds its nodes whole.
A result is written beside its file under a name that begins with a dot and renamed once it is whole, so that no
pattern of names finds half a file; a worker that is lost costs the file it was at.
"""

from __future__ import annotations

import hashlib
import os
import pathlib
import uuid
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from inpact._deck import Deck, from_json, read
from inpact._errors import DeckError
from inpact._evaluate import evaluate as evaluate_table

if TYPE_CHECKING:
    Path = str | os.PathLike[str]


@dataclass(frozen=True)
class Partition:
    """What came of one file.

    Attributes
    ----------
    source, target : str
        The file of node rows and that of results.
    rows : int
        How many rows both have, by their footers.
    sha256 : str
        Of the bytes of the result.
    """

    source: str
    target: str
    rows: int
    sha256: str


def evaluate(
    deck: Deck | Path,
    dataset: Path | Sequence[Path],
    out: Path,
    *,
    client: Any = None,
    **arguments: Any,
) -> list[Partition]:
    """Evaluate a Parquet dataset that is partitioned by node, a task a file, on a Dask cluster.

    Parameters
    ----------
    deck : Deck or path-like
        The deck; a path must be readable by every worker, a deck that was parsed goes along as it is.
    dataset : path-like or sequence of path-like
        A folder of ``.parquet`` files, or the files; every node must be in one file alone.
    out : path-like
        The folder of the results, which get the names of their files; it must not be the dataset's own.
    client : distributed.Client, optional
        The cluster; the current one where there is none.
    **arguments
        Keyword arguments of `inpact.evaluate`; ``threads`` is 1 unless said otherwise, as Dask counts on that.

    Returns
    -------
    list of Partition
        In the order of the files: rows in equal rows out, by the footers of both.

    Raises
    ------
    DeckError
        For a deck or rows with errors, and for a dataset whose nodes are spread over several files: the message
        has the command that repartitions it.
    """
    from distributed import get_client

    files = parquet_files(dataset)
    target = pathlib.Path(out)
    target.mkdir(parents=True, exist_ok=True)
    if any(file.parent.resolve() == target.resolve() for file in files):
        raise ValueError(f"`out`: `{target}` is the folder of the dataset: name another one")
    names = [file.name for file in files]
    if len(set(names)) < len(names):
        raise ValueError("`dataset`: two files have the same name, and results get the names of their files")
    refuse_cut_histories(files)
    source = deck_source(deck)
    cluster = client or get_client()
    arguments.setdefault("threads", 1)
    tasks = cluster.map(
        evaluate_file,
        [os.fspath(file) for file in files],
        deck=source,
        out=os.fspath(target),
        arguments=arguments,
        pure=False,
    )
    try:
        partitions: list[Partition] = cluster.gather(tasks)
    except BaseException:
        # What is wrong with one file would be of no use in the others.
        cluster.cancel(tasks)
        raise
    for name in target.glob(".*.parquet.part"):
        # Of a worker that was lost; those that are at work hold none any more.
        name.unlink(missing_ok=True)
    return partitions


def parquet_files(dataset: Path | Sequence[Path]) -> list[pathlib.Path]:
    """List the files of a dataset in the order of their names; hidden ones are none of them."""
    if isinstance(dataset, (str, os.PathLike)):
        folder = pathlib.Path(dataset)
        files = sorted(folder.glob("*.parquet")) if folder.is_dir() else [folder]
    else:
        files = [pathlib.Path(file) for file in dataset]
    files = [file for file in files if not file.name.startswith(".")]
    if not files:
        raise FileNotFoundError(f"`{dataset}` has no .parquet file")
    return files


def refuse_cut_histories(files: Sequence[pathlib.Path]) -> None:
    """Refuse a dataset of which one node lies in several files; without times rows stand for themselves.

    Raises
    ------
    DeckError
        With the command that repartitions it.
    """
    import pyarrow.compute as pc
    import pyarrow.parquet as pq

    found_in: dict[Any, pathlib.Path] = {}
    for file in files:
        names = {name.lower(): name for name in pq.read_schema(file).names}
        if "node" not in names or "time" not in names:
            continue
        for node in pc.unique(pq.read_table(file, columns=[names["node"]]).column(0)).to_pylist():
            other = found_in.setdefault(node, file)
            if other is not file:
                folder = file.parent
                raise DeckError(
                    f"node `{node}` is in `{other.name}` and in `{file.name}`, and its history must not be cut: "
                    f"repartition the dataset with `inpact.dask.repartition({str(folder)!r}, 'by-node')`"
                )


def repartition(dataset: Path | Sequence[Path], out: Path, *, partitions: int | None = None) -> list[str]:
    """Write a dataset anew so that every node is in one file alone; rows of a node keep their order.

    Parameters
    ----------
    dataset, out
        As for `evaluate`.
    partitions : int, optional
        How many files; as many as there were where it is not said.

    Returns
    -------
    list of str
        The files.
    """
    import numpy as np
    import pyarrow as pa
    import pyarrow.parquet as pq

    files = parquet_files(dataset)
    target = pathlib.Path(out)
    target.mkdir(parents=True, exist_ok=True)
    count = partitions or len(files)
    parts = [target / f"part-{number:05}.parquet" for number in range(count)]
    beside = [hidden(part) for part in parts]
    writers: list[Any] = [None] * count
    try:
        for file in files:
            for batch in pq.ParquetFile(file).iter_batches():
                name = next(name for name in batch.schema.names if name.lower() == "node")
                nodes = [str(node).encode() for node in batch.column(name).to_pylist()]
                # The same on every machine and in every run, unlike `hash`.
                part_of = np.array(
                    [int.from_bytes(hashlib.blake2b(node, digest_size=8).digest(), "big") % count for node in nodes]
                )
                for number in np.unique(part_of).tolist():
                    rows = batch.filter(pa.array(part_of == number))
                    if writers[number] is None:
                        writers[number] = pq.ParquetWriter(beside[number], batch.schema)
                    writers[number].write_batch(rows)
    finally:
        for writer in writers:
            if writer is not None:
                writer.close()
    written = []
    for part, hidden_part, writer in zip(parts, beside, writers, strict=True):
        if writer is not None:
            hidden_part.replace(part)
            written.append(os.fspath(part))
    return written


def deck_source(deck: Deck | Path) -> dict[str, str]:
    """Give what makes the deck again in another process: its path, or its lines as JSON, and its language."""
    if not isinstance(deck, Deck):
        return {"path": os.fspath(pathlib.Path(deck).resolve())}
    language = {"dialect": deck.dialect, "release": deck.release}
    try:
        return {"json": deck.to_json("syntax"), **language}
    except ValueError:
        # Its meshes were not kept: it is read again where it is.
        return {"path": deck.files[0], **language}


def deck_of(source: dict[str, str]) -> Deck:
    """Make the deck again."""
    dialect: Any = source.get("dialect")
    if "json" in source:
        return from_json(source["json"], dialect=dialect, release=source["release"])
    return read(source["path"], dialect=dialect, release=source.get("release"))


def evaluate_file(source: str, *, deck: dict[str, str], out: str, arguments: dict[str, Any]) -> Partition:
    """Evaluate one file; run by a worker."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    reader = pa.RecordBatchReader.from_batches(
        pq.read_schema(source), pq.ParquetFile(source).iter_batches(batch_size=65536)
    )
    result = evaluate_table(deck_of(deck), reader, **arguments)
    target = pathlib.Path(out) / pathlib.Path(source).name
    beside = hidden(target)
    try:
        stream = pa.RecordBatchReader.from_stream(result)
        with pq.ParquetWriter(beside, stream.schema) as writer:
            for batch in stream:
                writer.write_batch(batch)
        rows_in, rows_out = (pq.read_metadata(file).num_rows for file in (source, beside))
        if rows_in != rows_out:
            raise RuntimeError(f"`{source}` has {rows_in} rows, and its result {rows_out}: this is a bug")
        digest = hashlib.sha256(beside.read_bytes()).hexdigest()
        beside.replace(target)
    finally:
        beside.unlink(missing_ok=True)
    return Partition(source, os.fspath(target), rows_in, digest)


def hidden(target: pathlib.Path) -> pathlib.Path:
    """Name a file beside another that no pattern of names finds."""
    return target.with_name(f".{target.stem}-{uuid.uuid4().hex}.parquet.part")
