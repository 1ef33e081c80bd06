// Errors of filtered halves, judged by the other half: noise there is independent of what was filtered here.
#pragma once

namespace lancer::denoise {

// Of one channel of a pixel: squared error of (F(A) + F(B)) / 2, plus the variance of a half; unbiased, and about as
// noisy as the halves. Bitterli et al. 2016, section 4.3.
inline float squared_error_and_noise(float a, float b, float filtered_a, float filtered_b)
{
    const float of_a = b - filtered_a, of_b = a - filtered_b, apart = filtered_a - filtered_b;
    return 0.5f * (of_a * of_a + of_b * of_b) - 0.25f * apart * apart;
}

}  // namespace lancer::denoise
