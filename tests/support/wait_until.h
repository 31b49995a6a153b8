#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

namespace eyrie::test {

/// Waits for something that nobody tells of, such as how far another process is, by asking again and again. A minute
/// that passes without it fails the test, which goes on.
template <class Fact>
void waitUntil(const std::string& what, Fact&& holds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!holds()) {
        if (std::chrono::steady_clock::now() > end) {
            ADD_FAILURE() << "not within a minute: " << what;
            return;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

}  // namespace eyrie::test
