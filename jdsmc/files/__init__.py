"""Files that are whole or refused: written aside, sealed by a digest, replaced in one step."""
