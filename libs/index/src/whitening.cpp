// SPDX-License-Identifier: BSD-3-Clause
#include "whitening.h"

#include <limits>

namespace fild
{
namespace
{
Eigen::VectorXf to_vector(const GlobalDescriptor& descriptor)
{
    return Eigen::Map<const Eigen::VectorXf>(descriptor.data(),
                                             static_cast<Eigen::Index>(descriptor.size()));
}
}  // namespace

Whitening::Whitening(const std::vector<GlobalDescriptor>& descriptors, double shrinkage)
{
    const auto dimension = static_cast<Eigen::Index>(descriptors.front().size());
    const auto count = static_cast<Eigen::Index>(descriptors.size());
    Eigen::MatrixXf columns(dimension, count);
    for (Eigen::Index i = 0; i < count; ++i)
        columns.col(i) = to_vector(descriptors[static_cast<std::size_t>(i)]);
    mean_ = columns.rowwise().mean();
    columns.colwise() -= mean_;
    Eigen::MatrixXf covariance = columns * columns.transpose() / static_cast<float>(count);
    const float mean_variance = covariance.diagonal().mean();
    const float added = static_cast<float>(shrinkage) * mean_variance;
    // All alike: nothing to learn, any positive variance leaves the cosine as it is.
    covariance.diagonal().array() += added > 0 ? added : 1.0F;
    covariance_.compute(covariance);
}

GlobalDescriptor Whitening::apply(const GlobalDescriptor& descriptor) const
{
    Eigen::VectorXf whitened = covariance_.matrixL().solve(to_vector(descriptor) - mean_);
    const float norm = whitened.norm();
    if (norm > std::numeric_limits<float>::min()) whitened /= norm;
    return {whitened.data(), whitened.data() + whitened.size()};
}

}  // namespace fild
