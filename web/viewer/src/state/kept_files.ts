/** Files of the user that the browser stores on request, so that a reload and the user's own links find them. */

const kStore = "files";

/** Null if the browser does not store data. */
async function opened(): Promise<IDBDatabase | null> {
  return new Promise((resolve) => {
    try {
      const request = indexedDB.open("svt-viewer", 1);
      request.onupgradeneeded = () => request.result.createObjectStore(kStore);
      request.onsuccess = () => resolve(request.result);
      request.onerror = request.onblocked = () => resolve(null);
    } catch {
      resolve(null);
    }
  });
}

async function run<T>(mode: IDBTransactionMode, act: (store: IDBObjectStore) => IDBRequest<T>): Promise<{ result: T } | null> {
  const database = await opened();
  if (!database) return null;
  try {
    return await new Promise((resolve) => {
      const transaction = database.transaction(kStore, mode);
      const request = act(transaction.objectStore(kStore));
      transaction.oncomplete = () => resolve({ result: request.result });
      transaction.onerror = transaction.onabort = () => resolve(null);
    });
  } catch {
    return null;
  } finally {
    database.close();
  }
}

/** False if the browser has no room, or does not store data. */
export async function keepFile(name: string, data: ArrayBuffer): Promise<boolean> {
  return (await run("readwrite", (store) => store.put(new Blob([data]), name))) !== null;
}

export async function keptFile(name: string): Promise<Blob | null> {
  const found = (await run<unknown>("readonly", (store) => store.get(name)))?.result;
  return found instanceof Blob ? found : null;
}

export async function isKept(name: string): Promise<boolean> {
  return ((await run("readonly", (store) => store.count(name)))?.result ?? 0) > 0;
}

export async function forgetFile(name: string): Promise<void> {
  await run("readwrite", (store) => store.delete(name));
}
