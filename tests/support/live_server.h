#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace eyrie::test {

/// Answers the first connection over TCP with the first reply and closes it, the second with the second, and the ones
/// after the last with the last. A reply that begins with "HTTP/" waits for what is asked.
class LiveServer {
 public:
    explicit LiveServer(std::vector<std::string> replies) : replies_(std::move(replies)) {
        socket_ = ::socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        const bool listens = bind(socket_, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                             getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) == 0 &&
                             listen(socket_, 4) == 0;
        if (!listens) throw std::runtime_error("no port is free");
        port_ = ntohs(address.sin_port);
        thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
    }
    ~LiveServer() {
        thread_ = {};
        close(socket_);
    }
    LiveServer(const LiveServer&) = delete;
    LiveServer& operator=(const LiveServer&) = delete;

    /// "127.0.0.1:PORT".
    std::string place() const { return "127.0.0.1:" + std::to_string(port_); }
    /// That were taken so far.
    int connections() const { return connections_; }
    /// A file as a server of files sends it.
    static std::string httpReply(const std::string& bytes) {
        return "HTTP/1.0 200 OK\r\nContent-Type: video/mp2t\r\nContent-Length: " + std::to_string(bytes.size()) +
               "\r\n\r\n" + bytes;
    }

 private:
    void work(const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            if (!ready(socket_, POLLIN)) continue;
            const int connection = accept(socket_, nullptr, nullptr);
            if (connection < 0) continue;
            const auto number = static_cast<std::size_t>(connections_++);
            answer(connection, replies_[std::min(number, replies_.size() - 1)], stop);
            close(connection);
        }
    }
    static void answer(int connection, const std::string& reply, const std::stop_token& stop) {
        if (reply.starts_with("HTTP/")) {
            char asked[4096];
            while (!stop.stop_requested() && !ready(connection, POLLIN)) continue;
            if (recv(connection, asked, sizeof asked, 0) <= 0) return;
        }
        for (std::size_t at = 0; at < reply.size() && !stop.stop_requested();) {
            if (!ready(connection, POLLOUT)) continue;
            const ssize_t sent = send(connection, reply.data() + at, reply.size() - at, MSG_NOSIGNAL | MSG_DONTWAIT);
            if (sent <= 0) return;
            at += static_cast<std::size_t>(sent);
        }
    }
    static bool ready(int socket, short what) {
        pollfd waited{socket, what, 0};
        return poll(&waited, 1, 50) > 0;
    }

    std::vector<std::string> replies_;
    int socket_ = -1;
    int port_ = 0;
    std::atomic<int> connections_{0};
    std::jthread thread_;
};

}  // namespace eyrie::test
