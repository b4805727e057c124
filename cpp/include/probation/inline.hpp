#pragma once
// Functions that must leave no copy of their own behind: they are compiled once per instruction set.

#if defined(__GNUC__)
#define PROBATION_INLINE [[gnu::always_inline]] inline
#else
#define PROBATION_INLINE inline
#endif
