/* The study's own parts against known values. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_CHECK_H
#define STUDY_CHECK_H

/* Says what is not as near as it should be. */
void check_near(const char *what, double found, double expected, double relative);
void check_true(const char *what, int is_true);

/* FOLDER/friction.txt: values in 20 digits. */
void check_contact(const char *folder);
/* FOLDER/jkr.json, viscoelastic.json, layer.csv, where they are. */
void check_afm(const char *folder);
/* FOLDER/thin_sample.txt: forces on thin samples. */
void check_thin(const char *folder);
/* Layers in time. */

#endif
