#include "session/report_writer.h"

#include <QAbstractTextDocumentLayout>
#include <QDateTime>
#include <QFile>
#include <QFileInfo>
#include <QImage>
#include <QPageSize>
#include <QPainter>
#include <QPdfWriter>
#include <QSvgRenderer>
#include <QTextDocument>
#include <QThread>
#include <QUrl>
#include <exception>

#include "core/error.h"
#include "session/queued_call.h"

namespace eyrie::ui {

namespace {

constexpr int kDotsPerInch = 144;  ///< of the page; pictures are drawn twice as fine
constexpr double kMargin_mm = 15;
constexpr double kFigureScale = 3;
constexpr double kChipWidth = 84;     ///< of the page's px at 96 per inch
constexpr double kFigureWidth = 620;  ///< likewise

QImage pictureOf(const std::string& svg) {
    QSvgRenderer renderer(QByteArray::fromStdString(svg));
    QImage image(renderer.defaultSize() * kFigureScale, QImage::Format_RGB32);
    image.fill(Qt::white);
    QPainter painter(&image);
    renderer.render(&painter);
    return image;
}

/// Pictures get the width they have on the page, whatever their pixels.
void setWidth(QString& html, const QString& name, double width) {
    html.replace(QStringLiteral("<img src=\"%1\">").arg(name),
                 QStringLiteral("<img src=\"%1\" width=\"%2\">").arg(name).arg(qRound(width)));
}

[[noreturn]] void refuse(const QString& path, const QString& reason) {
    throw Error(ErrorKind::output,
                QStringLiteral("%1: cannot be written: %2. Choose another folder.").arg(path, reason).toStdString());
}

}  // namespace

namespace {

void writePdf(const std::filesystem::path& path, const EvaluationReportFile& report) {
    const QString name = QString::fromStdString(path.string());
    const QString part = name + QStringLiteral(".part");  // readers see a whole file or none
    QFile file(part);
    if (!file.open(QIODevice::WriteOnly)) refuse(name, file.errorString());
    {
        QPdfWriter writer(&file);
        writer.setPageSize(QPageSize(QPageSize::A4));
        writer.setPageMargins(QMarginsF(kMargin_mm, kMargin_mm, kMargin_mm, kMargin_mm), QPageLayout::Millimeter);
        writer.setResolution(kDotsPerInch);
        writer.setCreator(QStringLiteral("Eyrie"));
        QTextDocument document;
        QString html = QString::fromStdString(report.html);
        const double scale = kDotsPerInch / 96.0;
        for (const auto& [key, svg] : report.figures) {
            const QString source = QString::fromStdString(key);
            document.addResource(QTextDocument::ImageResource, QUrl(source), pictureOf(svg));
            setWidth(html, source, kFigureWidth * scale);
        }
        for (const auto& [key, png] : report.chips) {
            const QString source = QString::fromStdString(key);
            document.addResource(QTextDocument::ImageResource, QUrl(source),
                                 QImage::fromData(QByteArray::fromStdString(png)));
            setWidth(html, source, kChipWidth * scale);
        }
        QFont font(QStringLiteral("DejaVu Sans"));
        font.setPointSizeF(8.5);
        document.setDefaultFont(font);
        document.documentLayout()->setPaintDevice(&writer);
        document.setDefaultStyleSheet(QStringLiteral(
            "h1{font-size:16pt} h2{font-size:12pt;margin-top:14pt} td{font-size:8pt;padding:2px} th{font-size:8pt}"));
        html.remove(html.indexOf(QStringLiteral("<style>")),
                    html.indexOf(QStringLiteral("</style>")) + 8 - html.indexOf(QStringLiteral("<style>")));
        document.setHtml(html);
        document.setPageSize(QSizeF(writer.width(), writer.height()));
        document.print(&writer);
    }
    file.flush();
    const bool complete = file.error() == QFileDevice::NoError && file.size() > 0;
    const QString reason = file.errorString();
    file.close();
    if (!complete) {
        QFile::remove(part);
        refuse(name, reason);
    }
    std::error_code error;
    std::filesystem::rename(part.toStdString(), path, error);
    if (error) {
        QFile::remove(part);
        refuse(name, QString::fromStdString(error.message()));
    }
}

}  // namespace

void writePdfReport(const std::filesystem::path& path, const EvaluationReportFile& report) {
    // Text documents lay themselves out with timers, which only threads of Qt have.
    std::exception_ptr failure;
    const std::unique_ptr<QThread> thread(QThread::create([&] {
        try {
            writePdf(path, report);
        } catch (...) {
            failure = std::current_exception();
        }
    }));
    thread->start();
    thread->wait();
    if (failure) std::rethrow_exception(failure);
}

void ReportWriter::write(const std::filesystem::path& path, std::shared_ptr<const RunEvaluation> evaluation,
                         std::optional<Media> media) {
    if (working_ || !evaluation) return;
    working_ = true;
    request_ = std::stop_source();
    thread_.post([this, path, evaluation = std::move(evaluation), media = std::move(media),
                  stop = request_.get_token()](const std::stop_token&) {
        QString failure;
        try {
            std::unique_ptr<FrameSource> pixels;
            try {
                if (media) pixels = media->open({}, stop);
            } catch (const std::exception&) {
                // Without the video the report has no chips.
            }
            ReportOptions options;
            options.made_utc = QDateTime::currentDateTimeUtc().toString(Qt::ISODate).toStdString();
            const auto tell = [this](double share) { queuedCall(this, [this, share] { emit progress(share); }); };
            const EvaluationReportFile report = makeEvaluationReport(*evaluation, pixels.get(), options, tell, stop);
            if (stop.stop_requested()) return;
            if (QFileInfo(QString::fromStdString(path.string()))
                    .suffix()
                    .compare(QStringLiteral("pdf"), Qt::CaseInsensitive) == 0)
                writePdfReport(path, report);
            else
                writeHtmlReport(path, report);
        } catch (const std::exception& error) {
            failure = QString::fromUtf8(error.what());
        }
        queuedCall(this, [this, path, failure] {
            working_ = false;
            if (failure.isEmpty())
                emit written(path);
            else
                emit failed(failure);
        });
    });
}

}  // namespace eyrie::ui
