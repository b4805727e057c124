#pragma once
// Functions that must be inlined: a file that is compiled once per instruction set must not emit a copy of
// them, which the linker could take for another processor.

#if defined(__GNUC__)
#define PROBATION_INLINE [[gnu::always_inline]] inline
#else
#define PROBATION_INLINE inline
#endif
