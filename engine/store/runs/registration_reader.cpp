// The part of RunStore that reads how the frames were registered.
#include <SQLiteCpp/SQLiteCpp.h>

#include "store/database/rows.h"
#include "store/runs/run_store.h"

namespace eyrie {
namespace {

constexpr const char* kRows =
    "SELECT from_frame, to_frame, h00, h01, h02, h10, h11, h12, h20, h21, h22, inliers, rms_px, registration_state, "
    "reason, picture, reason_count, reason_of FROM frame WHERE run_id = ? AND frame >= ? ORDER BY frame";

Homography homographyOf(RowReader& row) {
    Homography homography;
    homography.from_frame = row.integer();
    homography.to_frame = row.integer();
    for (double& element : homography.matrix.val) element = row.real();
    homography.inliers = row.integer();
    homography.rms_px = row.real();
    return homography;
}

}  // namespace

std::vector<Homography> RunStore::homographies(int run_id, FrameIndex from) const {
    return guarded(project_.path(), "reading the registration of run " + std::to_string(run_id), [&] {
        SQLite::Statement statement(project_.database(), kRows);
        statement.bind(1, run_id);
        statement.bind(2, from);
        std::vector<Homography> homographies;
        while (statement.executeStep()) {
            RowReader row(statement);
            homographies.push_back(homographyOf(row));
        }
        return homographies;
    });
}

void RunStore::visitRegistrations(int run_id, const std::function<void(const Registration&)>& visitor) const {
    guarded(project_.path(), "reading the registration of run " + std::to_string(run_id), [&] {
        SQLite::Statement statement(project_.database(), kRows);
        statement.bind(1, run_id);
        statement.bind(2, 0);
        while (statement.executeStep()) {
            RowReader row(statement);
            Registration registration;
            registration.current_from_previous = homographyOf(row);
            registration.state = row.word(stored::kRegistrationStates);
            registration.failure = row.failure();
            visitor(registration);
        }
    });
}

std::vector<Registration> RunStore::registrations(int run_id) const {
    std::vector<Registration> registrations;
    visitRegistrations(run_id, [&](const Registration& each) { registrations.push_back(each); });
    return registrations;
}

}  // namespace eyrie
