#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"

namespace eyrie::test {

/// The message of the Error that `act` throws, or "no error".
template <class Act>
std::string messageOf(Act&& act) {
    try {
        act();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

/// The message of the Error that `act` must throw, after checking its kind.
template <class Act>
std::string messageOf(ErrorKind kind, Act&& act) {
    try {
        act();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), kind) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "no error was thrown";
    return {};
}

}  // namespace eyrie::test
