// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/place_states.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace fild
{
namespace
{
void multiply(std::vector<double>& values, const std::vector<double>& factors)
{
    std::transform(
        values.begin(), values.end(), factors.begin(), values.begin(), std::multiplies<>());
}
}  // namespace

double PlaceStates::sum() const
{
    return sum_of(same) + sum_of(look_alike) + new_ground;
}

void PlaceStates::normalize()
{
    const double total = sum();
    for (auto& each : same) each /= total;
    for (auto& each : look_alike) each /= total;
    new_ground /= total;
}

PlaceStates& PlaceStates::operator*=(const PlaceStates& other)
{
    multiply(same, other.same);
    multiply(look_alike, other.look_alike);
    new_ground *= other.new_ground;
    return *this;
}

double sum_of(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0);
}

std::vector<double> running_sums(const std::vector<double>& values)
{
    std::vector<double> sums(values.size() + 1, 0);
    std::partial_sum(values.begin(), values.end(), sums.begin() + 1);
    return sums;
}

double sum_around(const std::vector<double>& sums, std::size_t i, int reach)
{
    const auto step = static_cast<std::size_t>(reach);
    const auto end = std::min(sums.size() - 1, i + step + 1);
    return sums[end] - sums[i < step ? 0 : i - step];
}

std::vector<double> spread(const std::vector<double>& values, int step)
{
    const auto sums = running_sums(values);
    std::vector<double> moved(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        moved[i] = sum_around(sums, i, step) / (2 * step + 1);
    return moved;
}

}  // namespace fild
