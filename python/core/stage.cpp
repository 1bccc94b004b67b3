// SPDX-License-Identifier: LGPL-3.0-or-later
#include "stage.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <stop_token>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <pthread.h>

#include "arrays.hpp"

namespace terrane::python {
namespace {

constexpr std::chrono::milliseconds tick{50};
constexpr std::chrono::milliseconds patience{800}; ///< after a request to stop

std::atomic<int> abandoned{0}; ///< stages that run by themselves

/// What the calling thread and that of the stage share.
struct Shared {
    std::function<void(const Run&)> work;
    std::stop_source stop;
    std::mutex mutex;
    std::condition_variable changed;
    bool ended = false;
    bool left = false; ///< nobody waits any more
    bool news = false; ///< about the progress
    std::string stage;
    double share = 0;
    std::exception_ptr thrown;
};

void run_in_thread(const std::shared_ptr<Shared>& shared, unsigned threads, bool tells) {
    Run run{.threads = threads, .stop = shared->stop.get_token()};
    if (tells)
        run.progress = [&shared](std::string_view stage, double share) {
            const std::lock_guard lock(shared->mutex);
            shared->stage = stage;
            shared->share = share;
            shared->news = true;
        };
    std::exception_ptr thrown;
    try {
        shared->work(run);
    } catch (...) {
        thrown = std::current_exception();
    }
    shared->work = nullptr; // what it owns ends here, not in the waiting thread
    const std::lock_guard lock(shared->mutex);
    shared->thrown = thrown;
    shared->ended = true;
    if (shared->left) --abandoned;
    shared->changed.notify_all();
}

/// Threads that run stages, kept for the next ones: for each new thread that uses it, TBB keeps 10 kB for ever.
class ThreadPool {
public:
    /// Runs the job in a thread that is idle, or in a new one. Lack of threads is a lack of memory, as in
    /// the library.
    void run(std::function<void()> job) {
        Worker* worker = nullptr;
        {
            const std::lock_guard lock(mutex_);
            if (!idle_.empty()) {
                worker = idle_.back();
                idle_.pop_back();
            }
        }
        if (worker == nullptr) worker = started();
        const std::lock_guard lock(worker->mutex);
        worker->job = std::move(job);
        worker->changed.notify_one();
    }

private:
    /// Workers live until the process ends, and so does the pool.
    struct Worker {
        std::mutex mutex;
        std::condition_variable changed;
        std::function<void()> job;
    };

    Worker* started() {
        auto worker = std::make_unique<Worker>();
        {
            const std::lock_guard lock(mutex_);
            idle_.reserve(++workers_); // so that there is room when it becomes idle
        }
        try {
            std::thread([this, worker = worker.get()] { work(*worker); }).detach();
        } catch (const std::system_error&) {
            throw std::bad_alloc();
        }
        return worker.release();
    }

    void work(Worker& worker) {
        for (;;) {
            std::unique_lock lock(worker.mutex);
            worker.changed.wait(lock, [&] { return static_cast<bool>(worker.job); });
            const auto job = std::move(worker.job);
            worker.job = nullptr;
            lock.unlock();
            job();
            const std::lock_guard pool_lock(mutex_);
            idle_.push_back(&worker);
        }
    }

    std::mutex mutex_;
    std::vector<Worker*> idle_;
    std::size_t workers_ = 0;
};

ThreadPool* pool = nullptr; ///< never deleted: threads may wait in it when the process ends

/// Returns the pool; the GIL is held. A process that was forked has none of the threads of its parent, and
/// gets a pool of its own.
ThreadPool& threads_of_process() {
    if (pool == nullptr) {
        pool = new ThreadPool;
        static const int registered = pthread_atfork(nullptr, nullptr, [] {
            pool = nullptr;
            abandoned = 0;
        });
        static_cast<void>(registered);
    }
    return *pool;
}

/// Tells the callback of the progress if there are news. The GIL is held; the mutex is not.
void tell(Shared& shared, const py::object& progress) {
    std::string stage;
    double share = 0;
    {
        const std::lock_guard lock(shared.mutex);
        if (!std::exchange(shared.news, false)) return;
        stage = shared.stage;
        share = shared.share;
    }
    progress(to_text(stage), share);
}

/// Looks for signals and tells of the progress. Returns what that raised.
std::unique_ptr<py::error_already_set> attend(Shared& shared, const py::object& progress) {
    try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (!progress.is_none()) tell(shared, progress);
    } catch (py::error_already_set& raised) {
        return std::make_unique<py::error_already_set>(std::move(raised));
    }
    return nullptr;
}

/// Waits until the stage has ended, or has been told to stop and not done so. Returns what was raised
/// meanwhile, and leaves the stage to itself where it has not ended.
std::unique_ptr<py::error_already_set> wait(const std::shared_ptr<Shared>& shared,
                                            const py::object& progress) {
    std::unique_ptr<py::error_already_set> raised;
    const py::gil_scoped_release release;
    std::unique_lock lock(shared->mutex);
    const auto has_ended = [&] { return shared->ended; };
    while (!shared->changed.wait_for(lock, tick, has_ended)) {
        lock.unlock();
        {
            const py::gil_scoped_acquire acquire;
            raised = attend(*shared, progress);
        }
        lock.lock();
        if (!raised) continue;
        shared->stop.request_stop();
        if (!shared->changed.wait_for(lock, patience, has_ended)) {
            shared->left = true;
            ++abandoned;
        }
        break;
    }
    return raised;
}

py::object exception_of(const Error& error) {
    const auto module = py::module_::import("terrane._errors");
    return module.attr("exception_of")(static_cast<int>(error.code), to_text(error.sentence),
                                       to_text(error.place));
}

} // namespace

void run_watched(const HowToRun& how, std::function<void(const Run&)> work) {
    const auto shared = std::make_shared<Shared>();
    shared->work = std::move(work);
    threads_of_process().run([shared, threads = how.threads, tells = !how.progress.is_none()] {
        run_in_thread(shared, threads, tells);
    });
    auto raised = wait(shared, how.progress);
    if (!raised && !how.progress.is_none()) tell(*shared, how.progress);
    if (raised) throw std::move(*raised);
    if (shared->thrown) std::rethrow_exception(shared->thrown);
}

void wait_for_abandoned() {
    const py::gil_scoped_release release;
    while (abandoned > 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

void translate_errors() {
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Failure& failure) {
            const py::object exception = exception_of(failure.error);
            PyErr_SetObject(py::type::handle_of(exception).ptr(), exception.ptr());
        }
    });
}

} // namespace terrane::python
