#pragma once

#include <QObject>

namespace eyrie {

/// Turns SIGINT, SIGTERM and SIGHUP (Ctrl-C in the terminal, the end of the session, a closed terminal) into a signal
/// of Qt in the event loop, where everything may be done. Make it before any thread (so before the application), as
/// threads inherit what is blocked. Signals that whoever started us wants ignored stay so.
class EndingSignals : public QObject {
    Q_OBJECT

 public:
    explicit EndingSignals(QObject* parent = nullptr);
    ~EndingSignals() override;

    /// Begins to listen; needs the application.
    void watch();

 signals:
    void asked();

 private:
    int descriptor_ = -1;
};

}  // namespace eyrie
