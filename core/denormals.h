#pragma once
// Tiny numbers are flushed to zero while this lives: denormal arithmetic is a hundred times slower and carries nothing.
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace lahar {

class FlushDenormals {
 public:
#if defined(__SSE2__)
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040); }  // FTZ | DAZ
  ~FlushDenormals() { _mm_setcsr(saved_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
#else
  FlushDenormals() {}  // not defaulted: a guard that does nothing is no unused variable
#endif
};

}  // namespace lahar
