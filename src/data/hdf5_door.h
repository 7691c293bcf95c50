/* The one door through which bytes of HDF5 come in. A file that was made for it crashes the HDF5
 * library (1.10 by many ways, and there is no end of them), so the library opens it in a process of
 * its own: its end, however it comes, is an error here and nothing more.
 *
 * The process is a fork of the caller, without an exec: it needs no helper program that would have
 * to be found, it sees the bytes as they were checked, and it begins with HDF5 loaded. In a program
 * with threads it has the calling one alone. What it uses is safe then: memory (glibc keeps it
 * whole across a fork) and HDF5, whose lock is held while it is made (hdf5_scope.h). A program that
 * calls HDF5 itself from another thread may leave it locked: then reading ends at the limit of
 * time.
 *
 * The process has the signals of a new one, no open file but its answer, can open and write none
 * (so nothing leads out of the file), leaves no core and does not outlive the caller. What it may
 * take is limited. The caller's signal handlers are left alone: one that waits for every child may
 * take this one too, and then only the cause of a failure stays unknown.
 *
 * Not promised: that a made file cannot run code in that process. It runs as the user, and no more
 * is kept from it than is said here. Without /proc the limit of memory is left out.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DATA_HDF5_DOOR_H
#define WT_DATA_HDF5_DOOR_H

#include "weartrack/base.h"

#include <hdf5.h>

typedef struct hdf5_limits {
    size_t memory, answer;        /* bytes */
    unsigned cpu_time, wall_time; /* s */
} hdf5_limits;
/* What a file of this size may take: several times what a sound one does. */
hdf5_limits hdf5_limits_of(size_t size);

/* Runs behind the door: reads of the file, of so many bytes, what is wanted and prints it, tables
 * say. Only memory and HDF5 may be used, see above. */
typedef wt_status hdf5_reading(hid_t file, size_t size, FILE *answer, wt_error *err);

/* Gives what `reading` printed, new, freed with free(). It comes from where the file had its way:
 * nothing in it may be trusted. The error has no file name. */
wt_status hdf5_door_read(const void *bytes, size_t size, const hdf5_limits *limits,
                         hdf5_reading *reading, char **answer, size_t *length,
                         wt_error *err) WT_NODISCARD;

#endif
