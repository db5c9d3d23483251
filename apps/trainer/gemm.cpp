// LibTorch multiplies matrices through the Fortran function sgemm_. This one, found first because
// the program exports its symbols, hands the work to oneDNN, which is faster at our small sizes.

#ifdef LINEWRIGHT_HAS_DNNL

#include <oneapi/dnnl/dnnl.h>

extern "C" {

void sgemm_(const char* transpose_a, const char* transpose_b, const int* m, const int* n,
            const int* k, const float* alpha, const float* a, const int* lda, const float* b,
            const int* ldb, const float* beta, float* c, const int* ldc) {
  // Column by column is row by row with the factors swapped.
  dnnl_sgemm(*transpose_b, *transpose_a, *n, *m, *k, *alpha, b, *ldb, a, *lda, *beta, c, *ldc);
}

/// Tells prepare_learning() whose sgemm_ this is.
void linewright_sgemm_is_onednn() {}
}

#endif
