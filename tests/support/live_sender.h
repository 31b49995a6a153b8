#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace eyrie::test {

/// A port of this machine that nobody listens on just now.
inline int freePort() {
    const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    const bool bound = bind(socket, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                       getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0;
    close(socket);
    if (!bound) throw std::runtime_error("no port is free");
    return ntohs(address.sin_port);
}

/// Sends transport streams over UDP to this machine as an encoder would, one after the other, on a thread of its own.
class LiveSender {
 public:
    struct Part {
        std::filesystem::path file;
        double seconds = 1;       ///< that sending takes
        double pause_before = 0;  ///< s
    };

    LiveSender(int port, std::vector<Part> parts)
        : port_(port), parts_(std::move(parts)), thread_([this](const std::stop_token& stop) { work(stop); }) {}

 private:
    void work(const std::stop_token& stop) const {
        const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_port = htons(static_cast<std::uint16_t>(port_));
        to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        for (const Part& part : parts_) {
            pause(part.pause_before, stop);
            std::ifstream file(part.file, std::ios::binary);
            const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
            const auto begin = std::chrono::steady_clock::now();
            constexpr std::size_t kDatagram = 7 * 188;
            for (std::size_t at = 0; at < bytes.size() && !stop.stop_requested(); at += kDatagram) {
                const std::size_t size = std::min(kDatagram, bytes.size() - at);
                sendto(socket, bytes.data() + at, size, 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
                const double share = static_cast<double>(at) / static_cast<double>(bytes.size());
                std::this_thread::sleep_until(begin + std::chrono::duration<double>(part.seconds * share));
            }
        }
        close(socket);
    }
    static void pause(double seconds, const std::stop_token& stop) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        while (std::chrono::steady_clock::now() < end && !stop.stop_requested())
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }

    int port_;
    std::vector<Part> parts_;
    std::jthread thread_;
};

}  // namespace eyrie::test
