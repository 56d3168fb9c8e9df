// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/recording_choice.h"
#include "core/log/recording.h"
#include "core/model/session/session_view.h"

#include <QCoreApplication>
#include <QString>

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace posewire::gui {

/// How the recording that runs is doing.
struct TakeState {
    QString path;
    double seconds = 0;
    log::RecordingFigures figures;
};

/// Records what is received, one take after the other: each written from the log by a thread of its own, so
/// that neither receiving nor the window waits for the disk.
class Takes {
    Q_DECLARE_TR_FUNCTIONS(Takes)

public:
    explicit Takes(const log::PacketLog& log) : m_log(log) {}
    /// Waits until everything is in its file.
    ~Takes();
    Takes(const Takes&) = delete;
    Takes& operator=(const Takes&) = delete;

    /// Begins a take with what the pre-roll wants of the past. The answer is why it cannot, empty where it
    /// does.
    QString start(const RecordingChoice& choice, const model::SessionView& live);
    /// Has the marks and comments of the take as they are now noted in its file, without waiting for it.
    void keepMarks(const model::SessionView& live);
    /// Ends it, with notes of how it was received and of the incidents of its time.
    void stop(const model::SessionView& live);
    [[nodiscard]] bool isRecording() const { return m_recording != nullptr; }
    [[nodiscard]] std::optional<TakeState> state(const model::SessionView& live) const;

    /// Why a take has ended by itself, or could not be ended well, since this was asked last; empty where all
    /// is well.
    [[nodiscard]] std::string takeProblem();

private:
    /// How it was received, and the incidents of its time.
    [[nodiscard]] std::vector<std::string> notesOf(const model::SessionView& live) const;
    [[nodiscard]] log::Reception reception(const model::SessionView& live) const;

    const log::PacketLog& m_log;
    std::unique_ptr<log::Recording> m_recording; ///< null while none runs
    QString m_path;
    std::uint64_t m_from = 0;         ///< the first packet
    model::Annotations m_annotations; ///< as they are noted
    log::Stamp m_fromStamp{};
    log::Stamp m_begin{};                           ///< when it was started
    std::vector<std::future<std::string>> m_ending; ///< with what went wrong
};

} // namespace posewire::gui
