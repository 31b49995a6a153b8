#pragma once

#include <string>

namespace eyrie {

/// Whether an input is the address of a live source: rtsp://…, udp://…, srt://… and what else names a protocol of the
/// net.
bool isLiveAddress(const std::string& input);
/// Without name, password and what follows a "?", which may hold a passphrase: for messages and files.
std::string shownAddress(const std::string& address);
/// What is wrong with a text that should be the address of a live source, with what it should look like, for people;
/// empty where nothing can be told before it is tried.
std::string faultOfAddress(const std::string& address);

}  // namespace eyrie
