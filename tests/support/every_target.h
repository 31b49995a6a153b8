#pragma once

#include <hwy/targets.h>

#include <string>

namespace eyrie::test {

/// Runs `check(name)` once for each instruction set that this machine has and the program was built for.
template <class Check>
void forEveryTarget(Check check) {
    for (const auto target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        check(std::string(hwy::TargetName(target)));
    }
    hwy::SetSupportedTargetsForTest(0);
}

}  // namespace eyrie::test
