//! Matrix product of feature rows: the one place that calls the multiplication library.

/// `out[i · n + j] = a_i · b_j` for `m` rows of `a` and `n` rows of `b`, `k` numbers a row.
///
/// # Panics
/// When a slice is shorter than its shape says.
pub(super) fn row_products(a: &[f32], b: &[f32], k: usize, out: &mut [f32]) {
    if k == 0 {
        out.fill(0.0);
        return;
    }
    let (m, n) = (a.len() / k, b.len() / k);
    assert!(a.len() == m * k && b.len() == n * k && out.len() >= m * n, "shapes do not agree");
    #[expect(unsafe_code, reason = "the library takes pointers; the assertion above bounds them")]
    // SAFETY: `a` holds m×k and `b` n×k numbers, row by row (strides k and 1), and `out` holds
    // at least m×n; `out` is borrowed mutably and so overlaps neither.
    unsafe {
        matrixmultiply::sgemm(
            m,
            k,
            n,
            1.0,
            a.as_ptr(),
            k as isize,
            1,
            b.as_ptr(),
            1,
            k as isize,
            0.0,
            out.as_mut_ptr(),
            n as isize,
            1,
        );
    }
}
