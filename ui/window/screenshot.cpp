#include "window/screenshot.h"

#include <QApplication>
#include <QPixmap>
#include <QTimer>
#include <cstdio>

#include "widgets/wiring.h"
#include "window/main_window.h"

namespace eyrie::ui {

namespace {

constexpr int kPictureSettle_ms = 400;  ///< lists and charts follow the picture

class Photographer : public QObject {
 public:
    Photographer(MainWindow& window, std::filesystem::path file, int after_frames)
        : QObject(&window), window_(window), file_(std::move(file)), left_(after_frames) {
        ProjectSession& session = window_.session();
        whenChanged(session, this,
                    {{SessionChange::picture,
                      [this] {
                          if (window_.session().viewFrame().result && --left_ <= 0) shootSoon();
                      }},
                     {SessionChange::run_ended, [this] { shootSoon(); }}});
        connect(&session, &ProjectSession::problem, this, &Photographer::shootSoon);
        if (left_ <= 0) shootSoon();
    }

 private:
    void shootSoon() {
        if (shooting_) return;
        shooting_ = true;
        QTimer::singleShot(kPictureSettle_ms, this, [this] {
            if (!window_.grab().save(QString::fromStdString(file_.string()))) {
                std::fprintf(stderr, "eyrie: cannot write %s\n", file_.c_str());
                QApplication::exit(1);
                return;
            }
            window_.session().stopRun();  // nobody is there to be asked
            window_.close();
        });
    }

    MainWindow& window_;
    std::filesystem::path file_;
    int left_;
    bool shooting_ = false;
};

}  // namespace

void takeScreenshot(MainWindow& window, const std::filesystem::path& file, int after_frames) {
    new Photographer(window, file, after_frames);  // lives as long as the window
}

}  // namespace eyrie::ui
