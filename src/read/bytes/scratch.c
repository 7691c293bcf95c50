/* Creates temporary files without a name. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/bytes/scratch.h"

#include "core/system/temporary.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int scratch_open(void)
{
    const char *const folder = temporary_directory();
    int file = open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (file >= 0)
        return file;
    /* some file systems do not support O_TMPFILE */
    char *const path = wt_path_join(folder, "weartrack-XXXXXX");
    file = path != NULL ? mkostemp(path, O_CLOEXEC) : -1;
    if (file >= 0)
        (void)unlink(path);
    free(path);
    return file;
}

wt_status scratch_write(int file, const void *bytes, size_t n, const char *name, wt_error *err)
{
    for (size_t done = 0; done < n;) {
        const ssize_t written = write(file, (const char *)bytes + done, n - done);
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0) {
            wt_fail(err, WT_E_IO, "cannot be kept while it is read: %s", strerror(errno));
            wt_error_file(err, name);
            wt_error_advice(err, "set TMPDIR to a folder with room for all of it, unpacked");
            return WT_E_IO;
        }
        done += (size_t)written;
    }
    return WT_OK;
}
