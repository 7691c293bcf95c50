/* Runs the command like a user.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_PROGRAM_H
#define STUDY_PROGRAM_H

/* Arguments after the program; the last one is NULL. Standard error goes to a file. Returns the
 * exit status, 128 plus the signal number, or -1. */
int program_run(const char *program, const char *const *arguments, const char *errors);

#endif
