#include "session/background/background_query.h"

#include <QCoreApplication>
#include <QEvent>
#include <QObject>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <utility>

namespace eyrie::ui {

/// Calls on their way to the query's thread. Qt's event only says that there is one: what goes from thread to thread is
/// guarded here, where the thread sanitizer sees it.
class BackgroundTask::Answers {
 public:
    void put(std::function<void()> call) {
        const std::scoped_lock lock(mutex_);
        if (!receiver_) return;
        calls_.push_back(std::move(call));
        QCoreApplication::postEvent(receiver_.get(), new QEvent(QEvent::User));
    }
    /// To be called on the query's thread.
    void close() {
        std::deque<std::function<void()>> dropped;
        const std::scoped_lock lock(mutex_);
        receiver_.reset();
        dropped.swap(calls_);
    }

 private:
    class Receiver : public QObject {
     public:
        explicit Receiver(Answers& answers) : answers_(answers) {}

     protected:
        void customEvent(QEvent*) override {
            answers_.take()();  // which may be the end of this
        }

     private:
        Answers& answers_;
    };

    std::function<void()> take() {
        const std::scoped_lock lock(mutex_);
        std::function<void()> call = std::move(calls_.front());
        calls_.pop_front();
        return call;
    }

    std::mutex mutex_;
    std::deque<std::function<void()>> calls_;
    std::unique_ptr<Receiver> receiver_ = std::make_unique<Receiver>(*this);
};

void BackgroundTask::tell(std::function<void()> call) const {
    answers_->put([call = std::move(call), stop = stop_, is_question = is_question_] {
        if (!is_question || !stop.stop_requested()) call();
    });
}

/// The tasks of a query: shared with the pool, which may hold on to it a moment longer.
class BackgroundQuery::Tasks : public std::enable_shared_from_this<Tasks> {
 public:
    enum class Kind { posted, write, question, idle };

    Tasks(TaskPool& pool, std::shared_ptr<BackgroundTask::Answers> answers)
        : pool_(pool), answers_(std::move(answers)) {}

    std::stop_source add(Kind kind, Work work, Failed failed, Former former) {
        if (kind == Kind::question && former == Former::stop) cancel();
        std::stop_source idle;
        std::stop_source stop;
        {
            const std::scoped_lock lock(mutex_);
            if (ending_) return stop;
            if (kind == Kind::question) stop = questions_;
            if (kind == Kind::idle) stop = idle_stop_;
            Job job{std::move(work), std::move(failed), {}, stop, kind == Kind::write};
            job.task.answers_ = answers_;
            job.task.stop_ = stop.get_token();
            job.task.is_question_ = kind == Kind::question;
            if (kind != Kind::idle) {
                idle = std::exchange(idle_stop_, std::stop_source());
                idle_.reset();
            }
            if (kind == Kind::write) pool_.countWrites(1);
            if (kind == Kind::posted || kind == Kind::write)
                posted_.push_back(std::move(job));
            else
                (kind == Kind::question ? question_ : idle_) = std::move(job);
            schedule();
        }
        idle.request_stop();
        return stop;
    }

    /// Callbacks of what is stopped may do anything, so that no lock is held meanwhile.
    void cancel() {
        std::optional<Job> question;
        std::optional<Job> idle;
        std::unique_lock lock(mutex_);
        question.swap(question_);
        idle.swap(idle_);
        std::stop_source questions = std::exchange(questions_, std::stop_source());
        std::stop_source idle_stop = std::exchange(idle_stop_, std::stop_source());
        lock.unlock();
        questions.request_stop();
        idle_stop.request_stop();
    }

    void finishPosted() {
        std::unique_lock lock(mutex_);
        ended_.wait(lock, [this] { return posted_.empty() && !at_work_; });
    }

    void end() {
        cancel();
        std::deque<Job> dropped;
        std::unique_lock lock(mutex_);
        ending_ = true;
        // What comes before a write may be what it works on, as the opening of a project.
        while (!posted_.empty() && !posted_.back().is_write) {
            dropped.push_back(std::move(posted_.back()));
            posted_.pop_back();
        }
        std::stop_source posted = at_work_ && !writing_ && posted_.empty() ? *at_work_ : std::stop_source();
        lock.unlock();
        posted.request_stop();
        lock.lock();
        ended_.wait(lock, [this] { return posted_.empty() && !at_work_; });
        closed_ = true;
    }

 private:
    struct Job {
        Work work;
        Failed failed;
        BackgroundTask task;
        std::stop_source stop;
        bool is_write = false;
    };

    void schedule() {
        if (closed_ || at_work_) return;  // whoever is at work does this afterwards
        if (!posted_.empty() || question_) {
            if (!std::exchange(called_, true)) pool_.post([self = shared_from_this()] { self->work(false); });
        } else if (idle_ && !std::exchange(idle_called_, true)) {
            pool_.postIdle([self = shared_from_this()] { self->work(true); });
        }
    }

    std::optional<Job> next(bool idle) {
        if (closed_ || at_work_) return {};
        if (!posted_.empty()) {
            if (idle) return {};
            Job job = std::move(posted_.front());
            posted_.pop_front();
            return job;
        }
        if (idle != question_.has_value()) return std::exchange(idle ? idle_ : question_, std::nullopt);
        return {};
    }

    void work(bool idle) {
        std::unique_lock lock(mutex_);
        (idle ? idle_called_ : called_) = false;
        if (std::optional<Job> job = next(idle)) {
            at_work_ = job->stop;
            writing_ = job->is_write;
            lock.unlock();
            if (!run(*job) && job->is_write) pool_.countFailedWrite();
            job.reset();  // what it holds goes before anybody hears that it is done
            lock.lock();
            at_work_.reset();
            if (std::exchange(writing_, false)) pool_.countWrites(-1);
            ended_.notify_all();
        }
        schedule();
    }

    /// False where it failed.
    static bool run(const Job& job) {
        try {
            job.work(job.task);
            return true;
        } catch (const std::exception& error) {
            if (job.failed)
                job.task.tell([failed = job.failed, message = QString::fromUtf8(error.what())] { failed(message); });
            return false;
        }
    }

    TaskPool& pool_;
    std::shared_ptr<BackgroundTask::Answers> answers_;
    std::mutex mutex_;
    std::condition_variable ended_;
    std::deque<Job> posted_;
    std::optional<Job> question_;
    std::optional<Job> idle_;
    std::stop_source questions_;  ///< all since they were cancelled last
    std::stop_source idle_stop_;
    std::optional<std::stop_source> at_work_;
    bool called_ = false;  ///< the pool knows of what is to do
    bool idle_called_ = false;
    bool writing_ = false;  ///< what is at work is a write
    bool ending_ = false;   ///< nothing is added any more
    bool closed_ = false;
};

BackgroundQuery::BackgroundQuery(std::shared_ptr<TaskPool> pool)
    : pool_(std::move(pool)),
      answers_(std::make_shared<BackgroundTask::Answers>()),
      tasks_(std::make_shared<Tasks>(*pool_, answers_)) {}

BackgroundQuery::~BackgroundQuery() {
    tasks_->end();
    answers_->close();
}

std::stop_source BackgroundQuery::post(Work work, Failed failed) {
    return tasks_->add(Tasks::Kind::posted, std::move(work), std::move(failed), Former::finish);
}

void BackgroundQuery::write(Work work, Failed failed) {
    tasks_->add(Tasks::Kind::write, std::move(work), std::move(failed), Former::finish);
}

void BackgroundQuery::ask(Work work, Failed failed, Former former) {
    tasks_->add(Tasks::Kind::question, std::move(work), std::move(failed), former);
}

void BackgroundQuery::whenIdle(Work work) {
    tasks_->add(Tasks::Kind::idle, std::move(work), {}, Former::finish);
}

void BackgroundQuery::finishPosted() {
    tasks_->finishPosted();
}

void BackgroundQuery::cancel() {
    tasks_->cancel();
}

void BackgroundQuery::tell(std::function<void()> call) {
    answers_->put(std::move(call));
}

}  // namespace eyrie::ui
