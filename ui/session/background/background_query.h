#pragma once

#include <QString>
#include <functional>
#include <memory>
#include <stop_token>

#include "session/background/task_pool.h"

namespace eyrie::ui {

/// What a task sees of the query it belongs to. Copies may be kept and used on any thread.
class BackgroundTask {
 public:
    /// Requested when nobody wants the answer any more.
    const std::stop_token& stop() const { return stop_; }
    /// Calls on the query's thread, in the order told. Dropped when the query has gone by then, and for questions also
    /// when they were stopped.
    void tell(std::function<void()> call) const;

 private:
    friend class BackgroundQuery;
    class Answers;
    std::shared_ptr<Answers> answers_;
    std::stop_token stop_;
    bool is_question_ = false;
};

/// What one object of the window has done in the background, one task at a time. Makes of answers calls on the thread
/// it was made on, of exceptions messages there. Destruction stops the task at work, drops the others, waits, and
/// nothing is called any more; so it is the last member of its owner. What was to be written is written first, with
/// what was posted before it. May be used on any thread.
class BackgroundQuery {
 public:
    using Work = std::function<void(const BackgroundTask&)>;
    using Failed = std::function<void(const QString& message)>;
    /// What becomes of a question at work when a newer one comes.
    enum class Former {
        stop,   ///< it is stopped, and never answered
        finish  ///< it is answered all the same, so that something is shown however fast they come
    };

    explicit BackgroundQuery(std::shared_ptr<TaskPool> pool = TaskPool::common());
    ~BackgroundQuery();
    BackgroundQuery(const BackgroundQuery&) = delete;
    BackgroundQuery& operator=(const BackgroundQuery&) = delete;

    /// A task that is done after those posted before. Answers what stops it; told it is even then.
    std::stop_source post(Work work, Failed failed = {});
    /// The same for what a person did and is to be kept in a file: it is done even when this goes, and the window waits
    /// for it before it is closed.
    void write(Work work, Failed failed = {});
    /// A question. One that has not begun is replaced by a newer one; tasks that were posted are done before it.
    void ask(Work work, Failed failed = {}, Former former = Former::stop);
    /// Done when nothing else is to do, dropped or stopped as soon as something is. Takes the place of one not begun.
    void whenIdle(Work work);
    /// Waits until all that was posted is done. For an owner that goes and must not lose what it had written; not for
    /// tasks, and not with one among them that waits for the query's thread.
    void finishPosted();
    /// Stops questions and idle work; what they would tell is dropped.
    void cancel();
    /// For what a task has others do: calls on the query's thread, unless the query has gone by then.
    void tell(std::function<void()> call);

 private:
    class Tasks;
    std::shared_ptr<TaskPool> pool_;
    std::shared_ptr<BackgroundTask::Answers> answers_;
    std::shared_ptr<Tasks> tasks_;
};

}  // namespace eyrie::ui
