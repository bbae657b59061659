// Keeps a library valid while a source folder is empty.
