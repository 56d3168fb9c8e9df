// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/settings.h"

#include <QDialog>

class QCheckBox;
class QSpinBox;

namespace posewire::model {
class SessionView;
} // namespace posewire::model

namespace posewire::gui {

class History;

/// "512 MB in memory; on disk 1.2 GB of at most 8.0 GB, since 10:42:17": how far one can look back now.
[[nodiscard]] QString historyText(const model::SessionView& live, const History& history);

/// What is kept of what is received when memory is full.
class HistoryDialog final : public QDialog {
    Q_OBJECT

public:
    HistoryDialog(const model::SessionView& live, const History& history, const HistoryChoice& choice,
                  QWidget* parent);

    [[nodiscard]] HistoryChoice choice() const;

private:
    QCheckBox* m_isOnDisk;
    QSpinBox* m_gigabytes;
};

} // namespace posewire::gui
