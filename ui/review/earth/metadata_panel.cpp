#include "review/earth/metadata_panel.h"

#include <QComboBox>
#include <QLabel>
#include <QSignalBlocker>
#include <QTableView>
#include <QVBoxLayout>
#include <utility>

#include "review/earth/metadata_rows.h"
#include "review/earth/video_earth.h"
#include "widgets/display_text.h"
#include "widgets/empty_state.h"
#include "workspace/session_reactions.h"

namespace eyrie::ui {

MetadataPanel::MetadataPanel(ProjectSession& session, VideoEarth& earth, QWidget* parent)
    : MetadataPanel(session, earth, new MetadataModel, parent) {}

MetadataPanel::MetadataPanel(ProjectSession& session, VideoEarth& earth, MetadataModel* model, QWidget* parent)
    : TablePanel(model, QStringLiteral("metadata"), parent, std::nullopt),
      session_(session),
      earth_(earth),
      model_(model) {
    model_->setParent(this);
    table()->setAccessibleName(tr("Metadata of the frame"));
    streams_ = new QComboBox(this);
    streams_->setAccessibleName(tr("Stream of metadata"));
    streams_->setToolTip(tr("The video has several streams of metadata; places come from the one that says most"));
    streams_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    const auto line = [this] {
        auto* label = new QLabel(this);
        label->setWordWrap(true);
        label->setContentsMargins(6, 2, 6, 0);
        label->setTextInteractionFlags(Qt::TextSelectableByMouse);
        label->setTextFormat(Qt::PlainText);
        return label;
    };
    summary_ = line();
    ground_ = line();
    auto* rows = static_cast<QVBoxLayout*>(layout());
    rows->insertWidget(0, streams_);
    rows->insertWidget(1, summary_);
    rows->insertWidget(2, ground_);
    onEdited(
        this,
        [this] {
            showSummary();
            showFrame();
        },
        streams_);
    whenAny(&earth_, this, &MetadataPanel::showMetadata, &VideoEarth::changed);
    whenAny(&earth_, this, &MetadataPanel::explainNothing, &VideoEarth::readOn);
    followSession(session_, this, {{SessionChange::picture, [this] { showFrame(); }}});
    showMetadata();
}

std::optional<int> MetadataPanel::mostCharacters(int column) const {
    constexpr int kOfName = 17;  // beside it there is room for what it says
    return column == MetadataModel::name_column ? std::optional(kOfName) : std::nullopt;
}

void MetadataPanel::setLookedAt(bool looked_at) {
    looked_at_ = looked_at;
    if (looked_at && stale_) showMetadata();
}

const VideoMetadata* MetadataPanel::shownStream() const {
    const auto& found = earth_.metadata();
    const int number = streams_->currentIndex();
    if (!found || number < 0 || static_cast<std::size_t>(number) >= found->streams.size()) return nullptr;
    return found->streams[static_cast<std::size_t>(number)].get();
}

QString MetadataPanel::summary() const {
    return summary_->text();
}

void MetadataPanel::showMetadata() {
    stale_ = !looked_at_;
    showStreams();
    showSummary();
    showFrame();
}

void MetadataPanel::showStreams() {
    const QSignalBlocker quiet(streams_);
    const auto& found = earth_.metadata();
    const int before = streams_->currentIndex();
    QStringList names;
    int used = -1;
    for (std::size_t i = 0; found && i < found->streams.size(); ++i) {
        names << streamName(*found->streams[i], i);
        if (found->streams[i] == found->metadata) used = static_cast<int>(i);
    }
    QStringList shown;
    for (int i = 0; i < streams_->count(); ++i) shown << streams_->itemText(i);
    if (shown != names) {
        streams_->clear();
        streams_->addItems(names);
    }
    streams_->setCurrentIndex(shown == names && before >= 0 ? before : used >= 0 ? used : names.isEmpty() ? -1 : 0);
    streams_->setVisible(names.size() > 1);
}

void MetadataPanel::showSummary() {
    const VideoMetadata* stream = shownStream();
    const auto& times = session_.timesUs();
    summary_->setText(stream != nullptr && !times.empty() ? streamSummary(*stream, times.back()) : QString());
    summary_->setVisible(!summary_->text().isEmpty());
    explainNothing();
}

void MetadataPanel::explainNothing() {
    const auto& found = earth_.metadata();
    const QString by_hand =
        QLatin1String("\n\n") + tr("You can say by hand where it was taken, with the control points below.");
    if (!session_.media())
        emptyState()->setTexts(
            tr("Open a video first. What it says about its camera is listed here: time, place, angles and scale at the "
               "frame shown."));
    else if (!found)
        emptyState()->setTexts(tr("Looking for metadata: %1 %").arg(static_cast<int>(100 * earth_.readShare())));
    else if (!found->metadata && found->streams.empty())
        emptyState()->setTexts(capitalised(QString::fromStdString(found->why_not)) + QLatin1Char('.') + by_hand);
    else
        emptyState()->setTexts(tr("No set of this stream can be read.") + by_hand);
}

void MetadataPanel::showFrame() {
    if (!looked_at_) {
        stale_ = true;
        return;
    }
    const VideoMetadata* stream = shownStream();
    const FrameIndex frame = session_.shownFrame();
    const auto state = stream != nullptr ? earth_.stateOf(*stream, frame) : std::nullopt;
    if (!state || !session_.video()) {
        model_->setRows({});
        ground_->hide();
        return;
    }
    const GroundView view = groundViewOf(*state, session_.video()->size);
    const std::int64_t time_us = session_.timesUs()[static_cast<std::size_t>(frame)];
    model_->setRows(metadataRows(*stream, *state, stream->timeline().textsAt(time_us), view));
    QStringList lines;
    if (!earth_.origin().isEmpty()) lines << tr("Places: %1").arg(earth_.origin());
    for (const std::string& remark : view.remarks) lines << capitalised(QString::fromStdString(remark));
    ground_->setText(lines.join(QLatin1Char('\n')));
    ground_->setVisible(!lines.isEmpty());
}

}  // namespace eyrie::ui

#include "moc_metadata_panel.cpp"
