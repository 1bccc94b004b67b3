// SPDX-License-Identifier: LGPL-3.0-or-later
#include "stage.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <stop_token>
#include <string>
#include <system_error>
#include <thread>
#include <unordered_set>
#include <vector>

#include <cxxabi.h>
#include <pthread.h>

#include "arrays.hpp"

namespace terrane::python {
namespace {

constexpr std::chrono::milliseconds tick{50};
constexpr std::chrono::milliseconds patience{800}; ///< after a request to stop

/// What the calling thread and that of the stage share.
struct Shared {
    std::function<void(const Run&)> work;
    std::stop_source stop;
    std::mutex mutex;
    std::condition_variable changed;
    bool ended = false;
    bool news = false; ///< about the progress
    std::string stage;
    double share = 0;
    std::exception_ptr thrown;
};

void run_in_thread(Shared& shared, unsigned threads, bool tells) {
    Run run{.threads = threads, .stop = shared.stop.get_token()};
    if (tells)
        run.progress = [&shared](std::string_view stage, double share) {
            const std::lock_guard lock(shared.mutex);
            shared.stage = stage;
            shared.share = share;
            shared.news = true;
        };
    std::exception_ptr thrown;
    try {
        shared.work(run);
    } catch (...) {
        thrown = std::current_exception();
    }
    shared.work = nullptr; // what it owns ends here, not in the waiting thread
    const std::lock_guard lock(shared.mutex);
    shared.thrown = thrown;
    shared.ended = true;
    shared.changed.notify_all();
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

/// Blocks the thread until the process ends.
[[noreturn]] void wait_for_ever() {
    for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

/// The way back to the GIL, and the stages that run. Once the interpreter ends, Python before 3.14 ends any thread
/// that takes the GIL by pthread_exit, which aborts the process where frames of C++ are below. So the gate is closed
/// before: from then on, only the thread that ends the interpreter passes it.
class Gate {
public:
    /// Notes a stage that begins to run, whose thread calls `leave`. The GIL is held.
    void begin(Shared* stage) {
        std::unique_lock lock(mutex_);
        if (is_closed_to_me()) {
            lock.unlock();
            PyEval_SaveThread();
            wait_for_ever();
        }
        running_.insert(stage);
    }
    void leave(Shared* stage) {
        const std::lock_guard lock(mutex_);
        running_.erase(stage);
        changed_.notify_all();
    }
    /// Takes the GIL, which PyEval_SaveThread gave back. It does not return when the gate is closed.
    void take_gil(PyThreadState* state) {
        {
            std::unique_lock lock(mutex_);
            if (is_closed_to_me()) {
                lock.unlock();
                wait_for_ever();
            }
            ++takers_;
        }
        PyEval_RestoreThread(state);
        const std::lock_guard lock(mutex_);
        --takers_;
        changed_.notify_all();
    }
    /// Closes the gate, and waits for threads that have passed it and for all stages, which are told to stop: the
    /// process must not end under them. The GIL is held.
    void close() {
        PyThreadState* state = PyEval_SaveThread();
        {
            std::unique_lock lock(mutex_);
            closed_by_ = std::this_thread::get_id();
            for (Shared* stage : running_) stage->stop.request_stop();
            changed_.wait(lock, [&] { return takers_ == 0 && running_.empty(); });
        }
        PyEval_RestoreThread(state);
    }

private:
    [[nodiscard]] bool is_closed_to_me() const {
        return closed_by_ != std::thread::id() && closed_by_ != std::this_thread::get_id();
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::thread::id closed_by_; ///< no thread: it is open
    std::size_t takers_ = 0;    ///< threads that have passed the gate and wait for the GIL
    std::unordered_set<Shared*> running_;
};

/// What stages of this process share.
struct Process {
    ThreadPool pool;
    Gate gate;
};

Process* process = nullptr; ///< never deleted: threads may wait in it when the process ends

/// Returns what stages share; the GIL is held. A process that was forked has none of the threads of its parent, and
/// gets a pool and a gate of its own.
Process& this_process() {
    if (process == nullptr) {
        process = new Process;
        static const int registered = pthread_atfork(nullptr, nullptr, [] { process = nullptr; });
        static_cast<void>(registered);
    }
    return *process;
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
    const py::str text = to_text(stage);
    PyObject* returned = nullptr;
    try { // nothing here has a destructor: without the GIL, none may run
        returned = PyObject_CallFunction(progress.ptr(), "Od", text.ptr(), share);
    } catch (abi::__forced_unwind&) { // pthread_exit, as the interpreter ended during the call
        wait_for_ever();
    }
    if (returned == nullptr) throw py::error_already_set();
    Py_DECREF(returned);
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
/// meanwhile, and leaves the stage to itself where it has not ended. The GIL is held, but not while it waits.
std::unique_ptr<py::error_already_set> wait(Gate& gate, Shared& shared,
                                            const py::object& progress) {
    const auto ended_within = [&](std::chrono::milliseconds most) {
        PyThreadState* state = PyEval_SaveThread();
        std::unique_lock lock(shared.mutex);
        const bool ended = shared.changed.wait_for(lock, most, [&] { return shared.ended; });
        lock.unlock();
        gate.take_gil(state);
        return ended;
    };
    while (!ended_within(tick))
        if (auto raised = attend(shared, progress)) {
            shared.stop.request_stop();
            ended_within(patience);
            return raised;
        }
    return nullptr;
}

py::object exception_of(const Error& error) {
    const auto module = py::module_::import("terrane._errors");
    return module.attr("exception_of")(static_cast<int>(error.code), to_text(error.sentence),
                                       to_text(error.place));
}

} // namespace

void run_watched(const HowToRun& how, std::function<void(const Run&)> work) {
    Process& here = this_process();
    const auto shared = std::make_shared<Shared>();
    shared->work = std::move(work);
    here.gate.begin(shared.get());
    try {
        here.pool.run([&here, shared, threads = how.threads, tells = !how.progress.is_none()] {
            run_in_thread(*shared, threads, tells);
            here.gate.leave(shared.get());
        });
    } catch (...) { // there is no thread for it
        here.gate.leave(shared.get());
        throw;
    }
    const auto raised = wait(here.gate, *shared, how.progress);
    if (raised) throw std::move(*raised);
    if (!how.progress.is_none()) tell(*shared, how.progress);
    if (shared->thrown) std::rethrow_exception(shared->thrown);
}

void end_stages() {
    this_process().gate.close();
}

void translate_errors() {
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Failure& failure) {
            const py::object exception = exception_of(failure.error);
            PyErr_SetObject(py::type::handle_of(exception).ptr(), exception.ptr());
        } catch (const py::cast_error&) { // an element of a list, a state and so on
            PyErr_SetString(PyExc_TypeError, "a value has another type than it must have");
        }
    });
}

} // namespace terrane::python
