#pragma once

#include <opencv2/core/types.hpp>
#include <string>

namespace eyrie {

/// A size of pictures for messages: "768×576".
inline std::string sizeText(cv::Size size) {
    return std::to_string(size.width) + "×" + std::to_string(size.height);
}

}  // namespace eyrie
