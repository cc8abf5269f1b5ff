// SPDX-License-Identifier: BSD-3-Clause
// Runs the tests of one executable. Exit code 77, which ctest reports as skipped: all of them were.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>

int main(int argc, char** argv)
{
    constexpr int kSkipped = 77;
    ::testing::InitGoogleMock(&argc, argv);
    if (RUN_ALL_TESTS() != 0) return 1;
    if (::testing::GTEST_FLAG(list_tests)) return 0;
    const auto& tests = *::testing::UnitTest::GetInstance();
    if (tests.test_to_run_count() == 0)
    {
        std::cerr << "no test is called " << ::testing::GTEST_FLAG(filter) << "\n";
        return 1;
    }
    return tests.skipped_test_count() == tests.test_to_run_count() ? kSkipped : 0;
}
