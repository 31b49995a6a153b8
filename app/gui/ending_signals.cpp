#include "gui/ending_signals.h"

#include <sys/signalfd.h>
#include <unistd.h>

#include <QSocketNotifier>
#include <csignal>

namespace eyrie {

EndingSignals::EndingSignals(QObject* parent) : QObject(parent) {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction present {};
        if (sigaction(signal, nullptr, &present) == 0 && present.sa_handler != SIG_IGN) sigaddset(&set, signal);
    }
    descriptor_ = signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
    if (descriptor_ >= 0) pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

void EndingSignals::watch() {
    if (descriptor_ < 0) return;
    auto* notifier = new QSocketNotifier(descriptor_, QSocketNotifier::Read, this);
    connect(notifier, &QSocketNotifier::activated, this, [this] {
        signalfd_siginfo taken{};
        while (::read(descriptor_, &taken, sizeof taken) == sizeof taken) emit asked();
    });
}

EndingSignals::~EndingSignals() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace eyrie

#include "moc_ending_signals.cpp"
