#pragma once

#include <string>

namespace eyrie {

/// Whether an input is the address of a live source: rtsp://…, udp://…, srt://… and what else names a protocol of the
/// net, or a camera.
bool isLiveAddress(const std::string& input);
/// Whether an input names a camera of this machine: /dev/video0, /dev/v4l/…, camera:0 or camera:/dev/….
bool isCamera(const std::string& input);
/// The device of a camera: "/dev/video0" of "camera:0".
std::string cameraDevice(const std::string& camera);
/// Without name, password and what follows a "?", which may hold a passphrase: for messages and files.
std::string shownAddress(const std::string& address);
/// What is wrong with a text that should be the address of a live source, with what it should look like, for people;
/// empty where nothing can be told before it is tried.
std::string faultOfAddress(const std::string& address);

}  // namespace eyrie
