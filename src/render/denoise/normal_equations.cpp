#include "render/denoise/normal_equations.h"

#include <algorithm>

namespace lancer::denoise {
namespace {

constexpr size_t block = 6;  // sums of products that are kept in registers for each bandwidth

// Parts of a sum of squares that are added to it: Tikhonov's regularisation. The second is for members that do not
// vary, where others vary by about 1.
constexpr float ridge = 1e-3f, least_ridge = 1e-5f;

}  // namespace

template <size_t n>
void NormalEquations::add_products(const Observation* observations, const std::array<Float8, bandwidths>* weights,
                                   int count, size_t row, size_t first)
{
    std::array<std::array<Float8, n>, bandwidths> sum;
    for (size_t k = 0; k < bandwidths; ++k)
        for (size_t j = 0; j < n; ++j) sum[k][j] = sums_[k][row][first + j];
    for (int i = 0; i < count; ++i) {
        const Observation& z = observations[i];
        const Float8 a = weights[i][0] * z[3 + row], b = weights[i][1] * z[3 + row];
        for (size_t j = 0; j < n; ++j) {
            sum[0][j] = fmadd(a, z[first + j], sum[0][j]);
            sum[1][j] = fmadd(b, z[first + j], sum[1][j]);
        }
    }
    for (size_t k = 0; k < bandwidths; ++k)
        for (size_t j = 0; j < n; ++j) sums_[k][row][first + j] = sum[k][j];
}

void NormalEquations::add(const Observation* observations, const std::array<Float8, bandwidths>* weights, int count)
{
    for (size_t row = 0; row < basis_size; ++row) {
        const size_t end = 3 + row + 1;
        for (size_t first = 0; first < end; first += block) {
            const auto call = [&](auto n) { add_products<n>(observations, weights, count, row, first); };
            switch (std::min(block, end - first)) {
                case 1:
                    call(std::integral_constant<size_t, 1>{});
                    break;
                case 2:
                    call(std::integral_constant<size_t, 2>{});
                    break;
                case 3:
                    call(std::integral_constant<size_t, 3>{});
                    break;
                case 4:
                    call(std::integral_constant<size_t, 4>{});
                    break;
                case 5:
                    call(std::integral_constant<size_t, 5>{});
                    break;
                default:
                    call(std::integral_constant<size_t, block>{});
            }
        }
    }
}

// Cholesky's decomposition, then both triangular systems.
Coefficients NormalEquations::solve(size_t bandwidth) const
{
    const auto& sums = sums_[bandwidth];
    const Float8 scale = 1.0f / sums[0][3];  // the sum of weights is at least 1, that of the pixel itself
    std::array<std::array<Float8, basis_size>, basis_size> lower;
    std::array<Float8, basis_size> inverse_diagonal;
    for (size_t i = 0; i < basis_size; ++i) {
        for (size_t j = 0; j <= i; ++j) {
            Float8 s = sums[i][3 + j] * scale;
            if (i == j && i > 0) s += s * ridge + least_ridge;
            for (size_t m = 0; m < j; ++m) s = fnmadd(lower[i][m], lower[j][m], s);
            if (i == j)
                inverse_diagonal[i] = 1.0f / sqrt(s);
            else
                lower[i][j] = s * inverse_diagonal[j];
        }
    }
    Coefficients result;
    for (size_t c = 0; c < 3; ++c) {
        for (size_t i = 0; i < basis_size; ++i) {
            Float8 s = sums[i][c] * scale;
            for (size_t m = 0; m < i; ++m) s = fnmadd(lower[i][m], result[m][c], s);
            result[i][c] = s * inverse_diagonal[i];
        }
        for (size_t i = basis_size; i-- > 0;) {
            Float8 s = result[i][c];
            for (size_t m = i + 1; m < basis_size; ++m) s = fnmadd(lower[m][i], result[m][c], s);
            result[i][c] = s * inverse_diagonal[i];
        }
    }
    return result;
}

}  // namespace lancer::denoise
