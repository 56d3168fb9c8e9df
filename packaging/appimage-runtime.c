// SPDX-License-Identifier: GPL-3.0-or-later
// An AppImage of Posewire begins with this program. A squashfs image follows this program's own bytes, from the end of its section headers on.
// It is mounted by FUSE, or unpacked where that fails, and its AppRun is started with APPDIR, APPIMAGE, ARGV0 and OWD set, as
// https://github.com/AppImage/AppImageSpec asks. The mount ends when the last process does that inherited the pipe `alive`.
#define _GNU_SOURCE
#include <squashfuse.h>

#include <elf.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <fuse3/fuse.h>
#include <fuse3/fuse_lowlevel.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static const char kUsage[] =
    "usage: %s [OPTION of the AppImage | options of posewire]\n"
    "  A link to this file named posewire-cli starts the command line.\n"
    "  --appimage-extract-and-run  unpacks to a temporary folder instead of mounting, as where FUSE is missing\n"
    "  --appimage-extract          unpacks to the folder squashfs-root\n"
    "  --appimage-mount            mounts, and says where, until it is interrupted\n"
    "  --appimage-offset           tells the place of the squashfs image in this file\n"
    "  --appimage-help             shows this\n";

static sqfs s_image;
static volatile sig_atomic_t s_child;

static void fail(const char* what) {
    fprintf(stderr, "posewire: %s: %s\n", what, strerror(errno));
    exit(127);
}

/// Returns the length of the ELF file at `path`, which what is appended follows; 0 if it cannot be read.
static size_t elfSize(const char* path) {
    Elf64_Ehdr head;
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    const int isRead = file >= 0 && read(file, &head, sizeof head) == (ssize_t)sizeof head;
    close(file);
    return isRead ? head.e_shoff + (size_t)head.e_shentsize * head.e_shnum : 0;
}

// Files of the image, for FUSE.

static int find(const char* path, sqfs_inode* inode) {
    bool isFound = false;
    if (sqfs_inode_get(&s_image, inode, sqfs_inode_root(&s_image)) ||
        sqfs_lookup_path(&s_image, inode, path, &isFound)) {
        return -EIO;
    }
    return isFound ? 0 : -ENOENT;
}

static int getAttributes(const char* path, struct stat* status, struct fuse_file_info* unused) {
    (void)unused;
    sqfs_inode inode;
    const int error = find(path, &inode);
    if (error) {
        return error;
    }
    memset(status, 0, sizeof *status);
    status->st_mode = inode.base.mode;
    status->st_nlink = (nlink_t)inode.nlink;
    status->st_mtime = inode.base.mtime;
    status->st_uid = getuid();
    status->st_gid = getgid();
    if (S_ISREG(status->st_mode)) {
        status->st_size = (off_t)inode.xtra.reg.file_size;
        status->st_blocks = (status->st_size + 511) / 512;
    } else if (S_ISLNK(status->st_mode)) {
        status->st_size = (off_t)inode.xtra.symlink_size;
    }
    return 0;
}

static int readLink(const char* path, char* target, size_t size) {
    sqfs_inode inode;
    const int error = find(path, &inode);
    return error ? error : sqfs_readlink(&s_image, &inode, target, &size) ? -EIO : 0;
}

static int openFile(const char* path, struct fuse_file_info* opened) {
    sqfs_inode* inode = malloc(sizeof *inode);
    const int error = !inode ? -ENOMEM : (opened->flags & O_ACCMODE) != O_RDONLY ? -EROFS : find(path, inode);
    if (error) {
        free(inode);
        return error;
    }
    opened->fh = (uintptr_t)inode;
    opened->keep_cache = 1;
    return 0;
}

static int readFile(const char* path, char* bytes, size_t size, off_t from, struct fuse_file_info* opened) {
    (void)path;
    sqfs_off_t count = (sqfs_off_t)size;
    return sqfs_read_range(&s_image, (sqfs_inode*)(uintptr_t)opened->fh, from, &count, bytes) ? -EIO : (int)count;
}

static int closeFile(const char* path, struct fuse_file_info* opened) {
    (void)path;
    free((sqfs_inode*)(uintptr_t)opened->fh);
    return 0;
}

static int readFolder(const char* path, void* buffer, fuse_fill_dir_t add, off_t from, struct fuse_file_info* unused,
                      enum fuse_readdir_flags flags) {
    (void)from, (void)unused, (void)flags;
    sqfs_inode inode;
    sqfs_dir folder;
    const int error = find(path, &inode);
    if (error || sqfs_dir_open(&s_image, &inode, &folder, 0)) {
        return error ? error : -ENOTDIR;
    }
    sqfs_name name;
    sqfs_dir_entry entry;
    sqfs_err trouble = SQFS_OK;
    sqfs_dentry_init(&entry, name);
    add(buffer, ".", NULL, 0, 0);
    add(buffer, "..", NULL, 0, 0);
    while (sqfs_dir_next(&s_image, &folder, &entry, &trouble)) {
        add(buffer, sqfs_dentry_name(&entry), NULL, 0, 0);
    }
    return trouble ? -EIO : 0;
}

static void* start(struct fuse_conn_info* connection, struct fuse_config* config) {
    (void)connection;
    config->kernel_cache = 1; // the image does not change
    config->attr_timeout = config->entry_timeout = config->negative_timeout = 1e6;
    return NULL;
}

static const struct fuse_operations kOperations = {
    .init = start,        .getattr = getAttributes, .readlink = readLink, .open = openFile, .read = readFile,
    .release = closeFile, .readdir = readFolder,
};

static void say(enum fuse_log_level level, const char* format, va_list values) {
    (void)level, (void)format, (void)values; // what fails is unpacked
}

/// Answers the kernel until it unmounts or all writers of `alive` have ended.
static void serve(struct fuse* fuse, int alive) {
    struct fuse_session* session = fuse_get_session(fuse);
    struct fuse_buf request = {0};
    struct pollfd sources[] = {{fuse_session_fd(session), POLLIN, 0}, {alive, POLLIN, 0}};
    while (!fuse_session_exited(session)) {
        if (poll(sources, 2, -1) < 0 && errno != EINTR) {
            break;
        }
        if (sources[0].revents) {
            const int size = fuse_session_receive_buf(session, &request);
            if (size > 0) {
                fuse_session_process_buf(session, &request);
            } else if (size != -EINTR && size != -EAGAIN) {
                break;
            }
        } else if (sources[1].revents) {
            break;
        }
    }
    free(request.mem);
}

/// In a process of its own: mounts, writes a byte to `ready`, serves, unmounts and removes `folder`.
static void mountAndServe(const char* folder, int ready, int alive) {
    char* arguments[] = {"posewire", "-oro,nosuid,nodev,fsname=posewire,subtype=squashfs", NULL};
    struct fuse_args options = FUSE_ARGS_INIT(2, arguments);
    const int silence = open("/dev/null", O_RDWR | O_CLOEXEC);
    const int errors = dup(STDERR_FILENO);
    fuse_set_log_func(say);
    dup2(silence, STDERR_FILENO); // fusermount3 says why it fails
    struct fuse* fuse = fuse_new(&options, &kOperations, sizeof kOperations, NULL);
    const int isMounted = fuse && fuse_mount(fuse, folder) == 0;
    dup2(errors, STDERR_FILENO);
    close(errors);
    if (isMounted) {
        setsid(); // Ctrl+C is for the program
        dup2(silence, STDIN_FILENO);
        dup2(silence, STDOUT_FILENO);
        dup2(silence, STDERR_FILENO); // whoever reads our output waits for its end
        (void)!write(ready, "y", 1);
        close(ready);
        serve(fuse, alive);
        fuse_unmount(fuse);
    }
    rmdir(folder);
    _exit(0);
}

// Unpacking.

static void unpackFile(sqfs_inode* inode, const char* path) {
    static char bytes[1 << 20];
    const int file = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, inode->base.mode & 0777);
    if (file < 0) {
        fail(path);
    }
    for (sqfs_off_t done = 0, count; done < (sqfs_off_t)inode->xtra.reg.file_size; done += count) {
        count = sizeof bytes;
        if (sqfs_read_range(&s_image, inode, done, &count, bytes) || count <= 0) {
            errno = EIO;
            fail(path);
        }
        if (write(file, bytes, (size_t)count) != (ssize_t)count) {
            fail(path);
        }
    }
    close(file);
}

static void unpack(sqfs_inode_id id, const char* path) {
    sqfs_inode inode;
    if (sqfs_inode_get(&s_image, &inode, id)) {
        errno = EIO;
        fail(path);
    }
    if (S_ISREG(inode.base.mode)) {
        unpackFile(&inode, path);
    } else if (S_ISLNK(inode.base.mode)) {
        char target[PATH_MAX];
        size_t size = sizeof target;
        if (sqfs_readlink(&s_image, &inode, target, &size) || symlink(target, path)) {
            fail(path);
        }
    } else if (S_ISDIR(inode.base.mode)) {
        sqfs_name name;
        sqfs_dir folder;
        sqfs_dir_entry entry;
        sqfs_err trouble = SQFS_OK;
        if ((mkdir(path, 0755) && errno != EEXIST) || sqfs_dir_open(&s_image, &inode, &folder, 0)) {
            fail(path);
        }
        sqfs_dentry_init(&entry, name);
        while (sqfs_dir_next(&s_image, &folder, &entry, &trouble)) {
            char inner[PATH_MAX];
            snprintf(inner, sizeof inner, "%s/%s", path, sqfs_dentry_name(&entry));
            unpack(sqfs_dentry_inode(&entry), inner);
        }
        if (trouble) {
            errno = EIO;
            fail(path);
        }
    }
}

static int removeOne(const char* path, const struct stat* status, int kind, struct FTW* place) {
    (void)status, (void)kind, (void)place;
    return remove(path);
}

// Starting.

static void startProgram(const char* folder, char** arguments) {
    char program[PATH_MAX];
    snprintf(program, sizeof program, "%s/AppRun", folder);
    setenv("APPDIR", folder, 1);
    execv(program, arguments);
    fail(program);
}

/// Signals of a terminal reach the program by themselves.
static void passOn(int signal, siginfo_t* about, void* unused) {
    (void)unused;
    if (about->si_code <= 0) {
        kill(s_child, signal);
    }
}

/// Unpacks into `folder`, starts the program there and returns its exit status when it has ended; 128 and the number of a signal.
static int runUnpacked(char* folder, char** arguments) {
    unpack(sqfs_inode_root(&s_image), folder);
    s_child = fork();
    if (s_child == 0) {
        startProgram(folder, arguments);
    }
    const struct sigaction action = {.sa_sigaction = passOn, .sa_flags = SA_SIGINFO | SA_RESTART};
    const int passed[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2};
    for (size_t i = 0; i < sizeof passed / sizeof *passed; ++i) {
        sigaction(passed[i], &action, NULL);
    }
    int status = 127 << 8;
    while (waitpid(s_child, &status, 0) < 0 && errno == EINTR) {
    }
    nftw(folder, removeOne, 16, FTW_DEPTH | FTW_PHYS | FTW_MOUNT);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Returns 1 if the image is mounted at `folder`, until this process and those that it starts have ended.
static int mountAt(const char* folder) {
    int ready[2];
    int alive[2];
    if (pipe2(ready, O_CLOEXEC) || pipe(alive)) {
        fail("pipe");
    }
    if (fork() == 0) {
        if (fork() == 0) {
            close(ready[0]);
            close(alive[1]);
            mountAndServe(folder, ready[1], alive[0]);
        }
        _exit(0); // so that the program has no child that it does not know
    }
    wait(NULL);
    close(ready[1]);
    close(alive[0]);
    char byte;
    const int isMounted = read(ready[0], &byte, 1) == 1;
    close(ready[0]);
    if (!isMounted) {
        close(alive[1]);
    }
    return isMounted;
}

static char* makeFolder(void) {
    static char folder[PATH_MAX];
    const char* place = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%s/.posewire-XXXXXX", place && *place ? place : "/tmp");
    if (!mkdtemp(folder)) {
        fail(folder);
    }
    return folder;
}

static int isOption(const char* argument, const char* option) {
    return argument && strcmp(argument, option) == 0;
}

int main(int count, char** arguments) {
    (void)count;
    char self[PATH_MAX] = "";
    if (readlink("/proc/self/exe", self, sizeof self - 1) < 0) {
        fail("/proc/self/exe");
    }
    const size_t offset = elfSize(self);
    const char* option = arguments[1];
    if (isOption(option, "--appimage-help")) {
        printf(kUsage, arguments[0]);
        return 0;
    }
    if (isOption(option, "--appimage-offset")) {
        printf("%zu\n", offset);
        return 0;
    }
    if (sqfs_open_image(&s_image, self, offset)) {
        return 127; // it has said why
    }
    fcntl(s_image.fd, F_SETFD, FD_CLOEXEC);
    if (isOption(option, "--appimage-extract")) {
        unpack(sqfs_inode_root(&s_image), "squashfs-root");
        return 0;
    }
    char here[PATH_MAX];
    setenv("APPIMAGE", self, 1);
    setenv("ARGV0", arguments[0], 1);
    setenv("OWD", getcwd(here, sizeof here) ? here : "/", 1);
    char* folder = makeFolder();
    if (isOption(option, "--appimage-mount")) {
        if (!mountAt(folder)) {
            fprintf(stderr, "posewire: cannot mount: FUSE is missing, or not allowed\n");
            return 127;
        }
        puts(folder);
        fflush(stdout);
        return pause();
    }
    const int isToUnpack = isOption(option, "--appimage-extract-and-run");
    if (isToUnpack) {
        arguments[1] = arguments[0];
        ++arguments;
    }
    if (!isToUnpack && !getenv("APPIMAGE_EXTRACT_AND_RUN")) {
        if (mountAt(folder)) {
            startProgram(folder, arguments);
        }
        folder = makeFolder(); // the process that could not mount removes the first
    }
    return runUnpacked(folder, arguments);
}
