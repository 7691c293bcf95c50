/* Runs the command as a user does. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_PROGRAM_H
#define STUDY_PROGRAM_H

/* Arguments after the program, the last one NULL; what it says on standard error goes to a file.
 * The exit status, 128 + the number of the signal that ended it, or -1. */
int program_run(const char *program, const char *const *arguments, const char *errors);

#endif
