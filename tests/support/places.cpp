#include "support/places.h"

namespace eyrie::test {

std::filesystem::path sourceFolder() {
    return EYRIE_SOURCE_DIR;
}

std::filesystem::path sharedFolder() {
    return EYRIE_SHARED_DATA;
}

std::string programPath(const std::string& name) {
    return std::string(EYRIE_BIN_DIR) + "/" + name;
}

}  // namespace eyrie::test
