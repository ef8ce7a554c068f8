"""Columns that are more than a numpy array: texts, and arrays whose length changes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Union

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

Column = Union['NDArray[Any]', 'Texts', 'Ragged']
"""Values of one field: an array of shape (messages, ...), texts, or rows of changing length."""


class Texts:
    """An array of strings that keeps each text once, or nearly so."""

    def __init__(self, codes: NDArray[np.uint32], values: Sequence[str]) -> None:
        """Keep ``codes`` of any shape, the numbers of their texts in ``values``."""
        self.codes, self.values = codes, values

    @property
    def shape(self) -> tuple[int, ...]:
        """Of the array."""
        return self.codes.shape

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.codes)

    def __getitem__(self, key: Any) -> Any:
        """Return a text, or the part of the array that ``key`` selects."""
        part = self.codes[key]
        return Texts(part, self.values) if isinstance(part, np.ndarray) else self.values[part]

    def __iter__(self) -> Iterator[Any]:
        """Yield the rows."""
        return (self[i] for i in range(len(self)))

    def __eq__(self, other: object) -> Any:
        """Return for each element whether it is the text ``other``, or that of other `Texts`."""
        if isinstance(other, Texts):
            return self.numpy() == other.numpy()
        if not isinstance(other, str):
            return NotImplemented
        return np.isin(self.codes, [i for i, value in enumerate(self.values) if value == other])

    def __ne__(self, other: object) -> Any:
        """Return for each element whether it is another text than ``other``."""
        same = self.__eq__(other)
        return same if same is NotImplemented else ~same

    __hash__ = None  # type: ignore[assignment] # == is not identity

    def __repr__(self) -> str:
        """Return one line."""
        first = ', '.join(repr(self.values[i]) for i in self.codes.ravel()[:3])
        more = ', ...' if self.codes.size > 3 else ''
        return f'Texts({first}{more}; shape {self.shape})'

    def numpy(self) -> NDArray[np.object_]:
        """Return an array of str."""
        table = np.empty(len(self.values), object)
        table[:] = self.values
        return table[self.codes]

    def tolist(self) -> Any:
        """Return nested lists of str."""
        return self.numpy().tolist()

    @property
    def nbytes(self) -> int:
        """[bytes] of the codes, and of the texts without what Python adds."""
        return self.codes.nbytes + sum(map(len, self.values))


class Ragged:
    """Rows of changing length, one after another in one column of values."""

    def __init__(self, values: Column, offsets: NDArray[np.int64]) -> None:
        """Keep the values of all rows, and where each row begins (and the last one ends)."""
        self.values, self.offsets = values, offsets

    @property
    def lengths(self) -> NDArray[np.int64]:
        """Of every row."""
        return np.diff(self.offsets)

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.offsets) - 1

    def __getitem__(self, row: Any) -> Any:
        """Return the values of one row, or some of the rows by a slice of step 1."""
        if isinstance(row, slice):
            first, last, _ = row.indices(len(self))
            return Ragged(self.values, self.offsets[first : max(last, first) + 1])
        row = range(len(self))[row]
        return self.values[self.offsets[row] : self.offsets[row + 1]]

    def __iter__(self) -> Iterator[Any]:
        """Yield the rows."""
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        """Return one line."""
        lengths = self.lengths
        span = f'{lengths.min()} to {lengths.max()}' if len(lengths) else '0'
        return f'Ragged({len(self)} rows of {span} values)'

    def tolist(self) -> Any:
        """Return nested lists."""
        return [row.tolist() for row in self]

    @property
    def nbytes(self) -> int:
        """[bytes] of values and offsets."""
        return self.values.nbytes + self.offsets.nbytes
