"""A field cut into blocks, each of them one task."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

Block = tuple[int, int]
"""Row and column of a block among the blocks."""


@dataclass(frozen=True)
class BlockGrid:
    """Blocks of equal shape; the last of a row or column may be smaller.

    Attributes
    ----------
    shape, block : (int, int)
        Rows and columns of the field, and of a block.
    """

    shape: tuple[int, int]
    block: tuple[int, int]

    @property
    def count(self) -> tuple[int, int]:
        """Blocks along y and x."""
        return -(-self.shape[0] // self.block[0]), -(-self.shape[1] // self.block[1])

    def blocks(self) -> Iterator[Block]:
        """All of them, row by row."""
        down, across = self.count
        return ((row, column) for row in range(down) for column in range(across))

    def slices(self, block: Block) -> tuple[slice, slice]:
        """The pixels of a block."""
        first = [at * size for at, size in zip(block, self.block, strict=True)]
        ends = [min(at + size, all_) for at, size, all_ in zip(first, self.block, self.shape, strict=True)]
        return slice(first[0], ends[0]), slice(first[1], ends[1])


def block_grid(shape: tuple[int, int], chunks: tuple[int, int], pixels: int) -> BlockGrid:
    """Blocks of at most `pixels` pixels that lie along the chunks of the file, so that no chunk is read in vain.

    Chunks that are larger are halved, smaller ones joined.
    """
    block = [min(chunk, size) for chunk, size in zip(chunks, shape, strict=True)]
    while block[0] * block[1] > pixels:
        longer = 0 if block[0] >= block[1] else 1
        block[longer] = -(-block[longer] // 2)
    while 2 * block[0] * block[1] <= pixels:
        growing = [at for at in (0, 1) if block[at] < shape[at]]
        if not growing:
            break
        shorter = min(growing, key=lambda at: block[at])
        block[shorter] = min(2 * block[shorter], shape[shorter])
    return BlockGrid(shape, (block[0], block[1]))
