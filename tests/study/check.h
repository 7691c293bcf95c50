/* Tests of the study against known values.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_CHECK_H
#define STUDY_CHECK_H

/* Reports a value that differs by more than its tolerance. */
void check_near(const char *what, double found, double expected, double relative);
void check_true(const char *what, int is_true);

/* FOLDER/friction.txt: values with 20 digits. */
void check_contact(const char *folder);
/* FOLDER/jkr.json, viscoelastic.json, layer.csv, if they exist. */
void check_afm(const char *folder);
/* FOLDER/thin_sample.txt: forces on thin samples. */
void check_thin(const char *folder);
/* Growth of layers with time. */

#endif
