#pragma once

#include <filesystem>

namespace eyrie::ui {

class MainWindow;

/// Writes a picture of the window once it showed `after_frames` frames with results (0: as soon as anything is shown),
/// or the run ended before, and closes it. Prints an error and quits with 1 when the picture cannot be written.
void takeScreenshot(MainWindow& window, const std::filesystem::path& file, int after_frames);

}  // namespace eyrie::ui
