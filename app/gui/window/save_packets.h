// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/background.h"
#include "app/gui/theme/widgets.h"
#include "core/log/byte_io.h"
#include "core/model/session/session_view.h"

#include <QCheckBox>
#include <QDialog>
#include <QPushButton>
#include <QTimer>

#include <cstdint>
#include <memory>

namespace posewire::gui {

/// Saves packets of the history or of a recording as pcapng: of the selected range, those that are listed, or
/// all, of one character if that is wanted. What is received goes on meanwhile.
class SavePacketsDialog final : public QDialog {
    Q_OBJECT

public:
    /// `inUse` is the recording that is open. The log of the session must outlive this.
    SavePacketsDialog(model::SessionView& view, QString inUse, QWidget* parent);

    /// Writes what is chosen, on a thread of its own. A file that is there is replaced.
    void save(const QString& path);

private:
    using Result = tl::expected<std::uint64_t, log::FileError>;

    /// As a display filter; empty for all there is.
    [[nodiscard]] QString condition() const;
    void toggle();
    void watch();
    void showState(const QString& text);

    model::SessionView& m_view;
    const QString m_inUse;
    QComboBox* m_what = new ComboBox(this);
    QCheckBox* m_isOfOne = new QCheckBox(this);
    QLabel* m_state = dimText({}, this);
    QPushButton* m_button = new QPushButton(this);
    QTimer* m_watch = new QTimer(this);
    QString m_path;
    std::unique_ptr<Background<Result>> m_work;
};

} // namespace posewire::gui
