// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/settings.h"

#include <QDialog>

class QCheckBox;
class QSpinBox;

namespace posewire::gui {

class SessionDriver;

/// "512 MB in memory; on disk 1.2 GB of at most 8.0 GB, since 10:42:17": how far one can look back now.
[[nodiscard]] QString historyText(SessionDriver& driver);

/// What is kept of what is received when memory is full.
class HistoryDialog final : public QDialog {
    Q_OBJECT

public:
    HistoryDialog(SessionDriver& driver, const HistoryChoice& choice, QWidget* parent);

    [[nodiscard]] HistoryChoice choice() const;

private:
    QCheckBox* m_isOnDisk;
    QSpinBox* m_gigabytes;
};

} // namespace posewire::gui
