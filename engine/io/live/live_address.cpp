#include "io/live/live_address.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace eyrie {
namespace {

constexpr std::array<const char*, 11> kLiveSchemes{"udp",  "rtp",   "rtsp", "rtsps", "srt", "tcp",
                                                   "http", "https", "rtmp", "rtmps", "mmsh"};
constexpr char kBetween[] = "://";
constexpr char kCamera[] = "camera:";
constexpr char kDevices[] = "/dev/";
constexpr int kHighestPort = 65535;

bool isOneOf(const std::string& scheme, std::initializer_list<const char*> schemes) {
    return std::any_of(schemes.begin(), schemes.end(), [&](const char* known) { return scheme == known; });
}

/// "239.0.0.1:5000" of "udp://@239.0.0.1:5000?ttl=2".
std::string hostAndPort(const std::string& address) {
    const std::size_t begin = address.find(kBetween) + 3;
    const std::string place = address.substr(begin, address.find_first_of("/?", begin) - begin);
    return place.substr(place.rfind('@') + 1);  // npos + 1 is 0
}

std::string faultOfPort(const std::string& scheme, const std::string& place) {
    const std::size_t colon = place.rfind(':');
    const bool within_brackets = place.find(']') != std::string::npos && colon < place.find(']');
    if (colon == std::string::npos || within_brackets) {
        if (!isOneOf(scheme, {"udp", "rtp", "tcp", "srt"})) return {};
        return "the port is missing: " + scheme + kBetween + (place.empty() ? "@239.0.0.1" : place) + ":5000";
    }
    int port = 0;
    const char* end = place.data() + place.size();
    const auto [after, failed] = std::from_chars(place.data() + colon + 1, end, port);
    if (failed == std::errc{} && after == end && port >= 1 && port <= kHighestPort) return {};
    return "“" + place.substr(colon + 1) + "” is not a port; it is a number from 1 to " + std::to_string(kHighestPort);
}

bool isNumber(const std::string& text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

bool isCamera(const std::string& input) {
    return input.starts_with(kCamera) || input.starts_with("/dev/video") || input.starts_with("/dev/v4l/");
}

std::string cameraDevice(const std::string& camera) {
    if (!camera.starts_with(kCamera)) return camera;
    const std::string named = camera.substr(std::char_traits<char>::length(kCamera));
    return isNumber(named) ? "/dev/video" + named : named;
}

bool isLiveAddress(const std::string& input) {
    if (isCamera(input)) return true;
    const std::size_t end = input.find(kBetween);
    if (end == std::string::npos) return false;
    const std::string scheme = input.substr(0, end);
    return std::any_of(kLiveSchemes.begin(), kLiveSchemes.end(), [&](const char* known) { return scheme == known; });
}

std::string shownAddress(const std::string& address) {
    if (isCamera(address)) return address;
    const std::string shown = address.substr(0, address.find('?'));
    const std::size_t begin = shown.find(kBetween);
    const std::size_t end = begin == std::string::npos ? begin : shown.find('/', begin + 3);
    const std::size_t at = shown.rfind('@', end);
    // udp://@239.0.0.1 listens; a name and a password stand between.
    if (begin == std::string::npos || at == std::string::npos || at <= begin + 3) return shown;
    return shown.substr(0, begin + 3) + shown.substr(at + 1);
}

std::string faultOfAddress(const std::string& address) {
    if (address.empty())
        return "an address is needed, such as rtsp://camera/stream, udp://@239.0.0.1:5000 or /dev/video0";
    if (isCamera(address)) {
        if (cameraDevice(address).starts_with(kDevices)) return {};
        return "a camera is named by its number or its device, such as camera:0 or /dev/video0";
    }
    if (address.starts_with(kDevices))
        return "“" + address + "” is no camera; cameras of this machine are named like /dev/video0";
    if (address.find_first_of(" \t\n") != std::string::npos) return "an address has no blanks";
    const std::size_t end = address.find(kBetween);
    if (end == std::string::npos)
        return address.front() == '/' || address.front() == '~' || address.front() == '.'
                   ? "this is a file of this machine; open it by File ▸ Open video"
                   : "an address begins with how it is sent: rtsp://" + address + " or udp://" + address;
    const std::string scheme = address.substr(0, end);
    if (!isLiveAddress(address))
        return "“" + scheme +
               "” is not known; addresses begin with rtsp://, udp://, rtp://, srt://, tcp://, http:// or rtmp://";
    const std::string place = hostAndPort(address);
    // Those that are received without asking anybody need a port alone.
    if ((place.empty() || place.front() == ':') && !isOneOf(scheme, {"udp", "rtp", "srt"}))
        return "the name of the sender is missing: " + scheme + "://camera" + place;
    return faultOfPort(scheme, place);
}

}  // namespace eyrie
