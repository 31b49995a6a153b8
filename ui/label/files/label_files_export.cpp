#include "label/files/label_files_export.h"

#include <QCoreApplication>
#include <QStringList>

#include "core/error.h"
#include "exchange/project_labels.h"
#include "label/files/label_files_text.h"
#include "label/label_session.h"

namespace eyrie::ui {

namespace {

QString tell(const char* text) {
    return QCoreApplication::translate("LabelExport", text);
}

QString holdsText(const Carries& carries) {
    QStringList with;
    QStringList without;
    (carries.rotation ? with : without) << tell("rotation");
    (carries.id ? with : without) << tell("ids");
    (carries.object_class ? with : without) << tell("classes");
    (carries.occlusion ? with : without) << tell("occlusion");
    (carries.ignore ? with : without) << tell("ignored boxes");
    QString text = with.join(QStringLiteral(", "));
    if (!without.isEmpty()) text += tell("; not: %1").arg(without.join(QStringLiteral(", ")));
    return text;
}

}  // namespace

ExportOffer offerOf(const LabelFormatInfo& format) {
    ExportOffer offer;
    offer.name = QString::fromStdString(format.name);
    offer.title = QString::fromStdString(format.title);
    if (!format.folder && !format.extensions.empty())
        offer.ending = QString::fromStdString(format.extensions.front()).remove(QLatin1Char('.'));
    offer.holds = holdsText(format.carries);
    offer.asks_columns = format.name == "columns";
    offer.clips = true;
    return offer;
}

std::vector<OutputFile> labelOutputs(const ExportWish& wish, const ExportOptions& options) {
    std::vector<OutputFile> files;
    for (const ExportFile& file : filesToWrite(wish.path, wish.format, options))
        files.push_back({file.path, file.kind, file.grows, true});
    return files;
}

QString exportText(const ExportReport& report) {
    QString text = tell("Wrote %1 boxes.\n").arg(report.boxes);
    for (const auto& file : report.files) text += QString::fromStdString(file.string()) + QLatin1Char('\n');
    text += report.losses.empty() ? tell("Nothing was lost.\n") : tell("What the format could not hold:\n");
    for (const ExportLoss& loss : report.losses)
        text += QStringLiteral("• %1\n").arg(QString::fromStdString(loss.remark));
    return text + lines(report.notes);
}

ExportOptions exportOptionsOf(const ExportWish& wish, const std::filesystem::path& video) {
    ExportOptions options;
    options.columns = wish.columns;
    if (wish.clip) options.clip = true;
    options.sequence = video.stem().string();
    if (options.sequence.empty()) options.sequence = "sequence";
    return options;
}

ExportSource labelExport(const LabelSession& labels) {
    ExportSource source;
    source.title = tell("Export labels");
    source.name = tell("labels");
    for (const LabelFormatInfo& format : labelFormats())
        // Paths on the earth are of runs; labels have none.
        if (format.writes && (format.reads || !format.tells_world)) source.offers << offerOf(format);
    const SequenceRecord sequence = labels.sequence();
    source.read = {labels.projectPath(), sequence.path};
    source.files = [sequence](const ExportWish& wish) {
        return labelOutputs(wish, exportOptionsOf(wish, sequence.path));
    };
    source.begin = [&labels, of = source.read](const ExportWish& wish) -> ExportWork {
        if (!labels.isOpen() || of != std::vector<std::filesystem::path>{labels.projectPath(), labels.sequence().path})
            return [](const ExportProgress&, const std::stop_token&) -> QString {
                throw Error(ErrorKind::input,
                            tell("the labels that were to be exported are no longer open").toStdString());
            };
        return [set = labels.annotations(), sequence = labels.sequence(), camera = labels.sharedCamera(), wish](
                   const ExportProgress&, const std::stop_token& stop) {
            return exportText(writeLabels(labelStreamOf(set, sequence, *camera), wish.path, wish.format,
                                          exportOptionsOf(wish, sequence.path), stop));
        };
    };
    return source;
}

}  // namespace eyrie::ui
