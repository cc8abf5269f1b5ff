// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <streambuf>
#include <string>

namespace fild
{
/** To be called before anything is opened or printed. Standard descriptors that are closed lead to
 *  /dev/null from now on: no result file takes their number and receives what is printed. A write
 *  to a closed pipe, or beyond a limit of file sizes, fails from now on and does not end the
 *  process. */
void prepare_standard_streams();

/** Keeps from std::cerr, while it exists, the line that MRPT prints of each range scan whose
 *  calibration is for another size than its ranges; MRPT mends that by itself. Not thread-safe. */
class WithoutMrptWarnings : private std::streambuf
{
 public:
    WithoutMrptWarnings();
    WithoutMrptWarnings(const WithoutMrptWarnings&) = delete;
    WithoutMrptWarnings& operator=(const WithoutMrptWarnings&) = delete;
    ~WithoutMrptWarnings() override;

 private:
    int_type overflow(int_type character) override;
    int sync() override;
    void pass_on();

    std::streambuf* target_;
    std::string line_;  ///< not passed on: it begins as the warning does
};

/** Flushes std::cout. A reader that has closed its pipe has seen what it wanted: no error.
 *  \throw std::runtime_error when what was printed did not reach a file (disk full). */
void require_printed();

}  // namespace fild
