#pragma once

#include <string>

namespace eyrie::test {

/// SQL that takes a project of today back to what it was before the light and the zoom of runs were stored; other
/// versions of before go on from there.
inline const std::string kBackToSchema27 =
    "DROP VIEW v_frames; DROP VIEW v_tracks; DROP INDEX zoomed_frame; ALTER TABLE frame DROP COLUMN zoom; "
    "ALTER TABLE frame DROP COLUMN elapsed; "
    "DROP VIEW v_light; DROP VIEW v_frame_shadows; DROP VIEW v_box_trims; DROP TABLE light_finding; "
    "DROP TABLE frame_shadow; DROP TABLE box_trim; PRAGMA user_version = 27; ";

}  // namespace eyrie::test
