// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

namespace fild
{
/** Takes out of descriptors what all of them share: their mean, and by how much they vary together
 *  (Mahalanobis). The scalar product of two results is the cosine in the whitened space, whichever
 *  square root of the covariance is used; here it is the Cholesky factor. Const members may run
 *  concurrently. */
class Whitening
{
 public:
    /** Learns from descriptors of equal length, at least one.
     *  \param shrinkage  above 0: so many times the mean variance is added to each variance, which
     *         keeps directions that hardly occur from being blown up. */
    Whitening(const std::vector<GlobalDescriptor>& descriptors, double shrinkage);

    /** \param descriptor  of the length learnt from.
     *  \return the whitened descriptor, of unit norm; all zero when it equals the mean. */
    GlobalDescriptor apply(const GlobalDescriptor& descriptor) const;

 private:
    Eigen::VectorXf mean_;
    Eigen::LLT<Eigen::MatrixXf> covariance_;
};

}  // namespace fild
