// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace fild::testing
{
/** The message of the Error that `statement` throws; a failed test when it throws none. */
template <class Error, class Statement>
std::string message_of(Statement&& statement)
{
    try
    {
        statement();
    }
    catch (const Error& error)
    {
        return error.what();
    }
    ADD_FAILURE() << "expected an error, none was thrown";
    return "";
}

}  // namespace fild::testing
