// npm i && npm start: notes to drag around, which know which of them overlap.
import { createApp } from 'vue';
import App from './App.vue';

createApp(App).mount('#app');
