// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** Compiles a function once for any processor and once for those with the named extension of
 * x86-64; which runs is decided when the program is loaded. Elsewhere the function is compiled
 * once; with the thread sanitizer, too, which GCC 12 calls before it is there. A macro, because
 * attributes cannot be chosen otherwise. */
#if defined(__x86_64__) && !defined(__SANITIZE_THREAD__)
#define FILD_CLONED_FOR(extension) __attribute__((target_clones("default", extension)))
#else
#define FILD_CLONED_FOR(extension)
#endif
